// Tests of copies of other threads' grains that a thread reads, and of contacts in a new order.
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <random>

#include "engine/step/lists/histories.hpp"
#include "engine/step/threads/halo.hpp"

namespace grainreel {
namespace {

constexpr std::int32_t kGrains = 40, kCopiesAt = 48;
const Shares kShares{0, 10, 30, kGrains};  // the second of three threads reads

Vec3 place_of(std::int32_t i, int time) {
    return Vec3(i + 0.25, time, -i);
}

Grains some_grains(bool rounded) {
    Grains grains;
    for (std::int32_t i = 0; i < kGrains; ++i) grains.add(i, 0, place_of(i, 0), 1e-3, 2500);
    if (rounded) grains.rounded.resize(kGrains);
    return grains;
}

void move_to(Grains& grains, int time) {
    for (std::int32_t i = 0; i < kGrains; ++i) {
        grains.place[i].position = place_of(i, time);
        grains.motion[i].velocity = Vec3(time, i, 1);
        grains.motion[i].spin = Vec3(-time, i, 2);
        if (!grains.rounded.empty()) grains.rounded[i].spin[1] = static_cast<float>(100 * time + i);
    }
}

// The thread reads 7, 9 and 35 of the others.
Halo halo_of(Grains& grains) {
    Halo halo;
    halo.own(10, 30, 9, kGrains);
    for (const std::int32_t i : {35, 9, 20, 7, 9, 29}) halo.need(i);
    halo.make_room(kCopiesAt, 3);
    reserve_copies(grains, kCopiesAt - kGrains + halo.size());
    halo.end_list(grains, kShares);
    return halo;
}

void send(Halo& halo, const Grains& grains, int box) {
    for (const int owner : {0, 2}) halo.put(grains, nullptr, owner, box);
}

class HaloOf : public testing::TestWithParam<bool> {};

TEST_P(HaloOf, BringsWhatOwnersHadWhenTheyPutItIn) {
    Grains grains = some_grains(GetParam());
    Halo halo = halo_of(grains);
    ASSERT_EQ(halo.size(), 3);
    move_to(grains, 1);
    send(halo, grains, 0);
    move_to(grains, 2);
    send(halo, grains, 1);
    const std::int32_t first[] = {7, 9, 12}, second[] = {12, 35, 13};
    std::int32_t one[kBlock], two[kBlock];
    std::copy_n(first, 3, one), std::copy_n(second, 3, two);
    std::fill(one + 3, one + kBlock, 12), std::fill(two + 3, two + kBlock, 13);
    KickInput kicks;
    kicks.drift = 1;  // would show if copies that have come are moved again
    for (const int box : {0, 1}) {
        halo.get(grains, box, {kicks, true});
        const Halo::Bodies at = halo.find(one, two, 3);
        EXPECT_EQ(at.second[0], 12);  // its own grains stay at their places
        EXPECT_EQ(at.first[2], 12);
        const std::pair<std::int32_t, std::int32_t> foreign[] = {
            {at.first[0], 7}, {at.first[1], 9}, {at.second[1], 35}};
        for (const auto& [copy, grain] : foreign) {
            EXPECT_GE(copy, kCopiesAt);
            EXPECT_EQ(grains.place.data()[copy].position, place_of(grain, box + 1));
            EXPECT_EQ(grains.place.data()[copy].radius, 1e-3);
            if (GetParam()) {
                EXPECT_EQ(grains.rounded.data()[copy].spin[1], static_cast<float>(100 * (box + 1) + grain));
            } else {
                EXPECT_EQ(grains.motion.data()[copy].velocity, Vec3(box + 1, grain, 1));
                EXPECT_EQ(grains.motion.data()[copy].spin, Vec3(-box - 1, grain, 2));
            }
        }
    }
}

// Copies that are not sent move bit by bit as their owners move them: owners send only grains with contacts.
TEST_P(HaloOf, LetsCopiesFlyThatDoNotCome) {
    Grains grains = some_grains(GetParam());
    move_to(grains, 1);
    Halo halo = halo_of(grains);
    const std::int32_t foreign[] = {7, 9, 35};
    Loaded loaded[3];
    for (int owner = 0; owner < 3; ++owner) loaded[owner].clear(kShares[owner], kShares[owner + 1]);
    loaded[0].note(9);
    KickInput kicks{Vec3(0.1, -0.2, -9.81), true, 0.99, Vec3(0.3, 0.7, -0.5), 1e-3, 2e-3, 0.05, 0.1};
    for (int step = 0; step < 3; ++step) {
        grains.load[9].force = Vec3(step, 1, -2);
        grains.load[9].torque = Vec3(1, step, 3);
        const auto move = step == 0 ? kick_and_drift : kick_and_go_on;
        move(grains, kicks, 0, kGrains);
        for (const int owner : {0, 2}) halo.put(grains, &loaded[owner], owner, step % 2);
        halo.get(grains, step % 2, {kicks, step == 0});
        for (int k = 0; k < 3; ++k) {
            const std::int32_t copy = kCopiesAt + k, own = foreign[k];
            EXPECT_EQ(grains.place.data()[copy].position, grains.place[own].position) << own << ' ' << step;
            if (GetParam()) {
                EXPECT_EQ(
                    std::memcmp(&grains.rounded.data()[copy], &grains.rounded[own], sizeof(RoundedMotion)), 0)
                    << own << ' ' << step;
            } else {
                EXPECT_EQ(grains.motion.data()[copy].velocity, grains.motion[own].velocity);
                EXPECT_EQ(grains.motion.data()[copy].spin, grains.motion[own].spin);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Precision, HaloOf, testing::Bool(),
                         [](const auto& one) { return one.param ? "mixed" : "full"; });

// Chunks of own grains stay as they are listed; the others are as find() gives them.
TEST(FoundPairs, AreWhatFindSays) {
    Grains grains = some_grains(false);
    Halo halo = halo_of(grains);
    const std::int32_t count = 3 * kChunk - 5, room = 3 * kChunk;
    std::vector<std::int32_t> first(room, 15), second(room, 16);
    first[kChunk + 3] = 7;
    second[3 * kChunk - 6] = 35;
    FoundPairs found;
    found.set(halo, first.data(), second.data(), count);
    EXPECT_EQ(found.of(first.data(), second.data(), 0).first, first.data());
    for (const std::int32_t c : {kChunk, 2 * kChunk}) {
        const int many = std::min(kChunk, count - c);
        const Halo::Bodies expected = halo.find(first.data() + c, second.data() + c, many);
        const Halo::Bodies got = found.of(first.data(), second.data(), c);
        EXPECT_TRUE(std::equal(got.first, got.first + many, expected.first)) << c;
        EXPECT_TRUE(std::equal(got.second, got.second + many, expected.second)) << c;
        EXPECT_NE(got.first, first.data() + c);
    }
    halo.begin_list();
    found.set(halo, first.data(), second.data(), count);
    EXPECT_EQ(found.of(first.data(), second.data(), kChunk).first, first.data() + kChunk);
}

// Some contacts go and some late ones come in between, as when a table is sorted.
TEST(Reorder, PutsEachContactsNumbersWhereTheOrderSays) {
    std::mt19937 random(1);
    for (const std::size_t number_size : {sizeof(double), sizeof(float)}) {
        for (const std::int32_t kept_first : {0, 5, 64}) {
            constexpr std::int32_t kBefore = 20 * kBlock;
            Histories histories;
            histories.shape(3, number_size);
            histories.resize(kBefore);
            for (std::int32_t c = 0; c < kBefore; ++c)
                for (int k = 0; k < 3; ++k) histories.set(c, k, 3 * c + k);
            LargeArray<std::int32_t> order;
            for (std::int32_t c = 0; c < 17 * kBlock; ++c) {
                if (c < kept_first || random() % 20 != 0) order.push_back(c);
                if (c >= kept_first && random() % 40 == 0) order.push_back(17 * kBlock + c % (3 * kBlock));
            }
            Reorder reorder;
            reorder.set(order);
            histories.reorder(reorder, kBefore);
            for (std::int32_t c = 0; c < std::ssize(order); ++c)
                for (int k = 0; k < 3; ++k)
                    ASSERT_EQ(histories.get(c, k), 3 * order[c] + k) << number_size << ' ' << kept_first;
        }
    }
}

}  // namespace
}  // namespace grainreel
