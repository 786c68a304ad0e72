// Grains without contacts, whose loads are left alone.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/step/forces/integrate.hpp"

namespace grainreel {
namespace {

constexpr std::int32_t kBegin = 7, kEnd = 200;
constexpr std::int32_t kPushed[] = {8, 70, 71, 134, 198};

bool is_pushed(std::int32_t i) {
    return std::find(std::begin(kPushed), std::end(kPushed), i) != std::end(kPushed);
}

Loaded noted() {
    Loaded loaded;
    loaded.clear(kBegin, kEnd);
    for (const std::int32_t i : kPushed) loaded.note(i), loaded.note(i);
    loaded.note(kBegin - 1), loaded.note(kEnd);
    return loaded;
}

Grains pushed_grains() {
    Grains grains;
    for (std::int32_t i = 0; i < kEnd; ++i) {
        grains.add(i, 0, Vec3(i, 2 * i, -i), 1e-3, 2500);
        grains.motion[i].velocity = Vec3(1, -0.3 * i, 2);
        grains.motion[i].spin = Vec3(i, 3, 0.1);
        if (is_pushed(i)) grains.load[i] = {Vec3(1e-3 * i, -2e-3, 0.1), 0, Vec3(0, 1e-6 * i, 3e-6), 0};
    }
    return grains;
}

TEST(Loaded, HoldsABitForEachGrainThatWasNoted) {
    const Loaded loaded = noted();
    EXPECT_TRUE(loaded.few());
    for (std::int32_t i = kBegin; i < kEnd; ++i)
        for (std::int32_t k = 0; k < 64 && i + k < kEnd; ++k)
            ASSERT_EQ(loaded.from(i) >> k & 1, is_pushed(i + k)) << i << ' ' << k;
}

TEST(Loaded, AreNotFewWhenOneInFourHasContacts) {
    Loaded loaded;
    loaded.clear(0, 40);
    for (std::int32_t i = 0; i < 10; ++i) loaded.note(3 * i);
    EXPECT_TRUE(loaded.few());
    loaded.note(1);
    EXPECT_FALSE(loaded.few());
}

// The same motion, to the last bit, as with all loads read; wherever a stretch of grains begins and ends.
TEST(Loaded, GrainsGoOnAsIfAllLoadsWereRead) {
    const Loaded loaded = noted();
    KickInput all{{0.1, 0, -9.81}, true};
    all.end_kick = all.begin_kick = 5e-6, all.drift = 1e-5;
    KickInput some = all;
    some.loaded = &loaded;
    for (std::int32_t cut = kBegin; cut < kBegin + 9; ++cut) {
        Grains expected = pushed_grains(), got = pushed_grains();
        const Vec3 fastest = kick_and_go_on(expected, all, kBegin, kEnd);
        const Vec3 first = kick_and_go_on(got, some, kBegin, cut);
        EXPECT_EQ(fastest, first.cwiseMax(kick_and_go_on(got, some, cut, kEnd)));
        for (std::int32_t i = kBegin; i < kEnd; ++i) {
            ASSERT_EQ(got.place[i].position, expected.place[i].position) << i;
            ASSERT_EQ(got.motion[i].velocity, expected.motion[i].velocity) << i;
            ASSERT_EQ(got.motion[i].spin, expected.motion[i].spin) << i;
            ASSERT_EQ(got.load[i].force, Vec3(0, 0, 0)) << i;
        }
    }
}

}  // namespace
}  // namespace grainreel
