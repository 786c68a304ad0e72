// Which candidates are looked at in a step.
#include <gtest/gtest.h>

#include <random>

#include "engine/step/soon.hpp"

namespace grainreel {
namespace {

TEST(Soon, HoldsPairsInOrderAndFillsTheLastBlock) {
    Soon soon;
    soon.expire(60);
    soon.begin(0, 1);
    for (std::int32_t k = 0; k < 21; ++k) soon.add(k, 100 + k, 2 * k);
    soon.end();
    ASSERT_EQ(soon.size(), 21);
    for (std::int32_t k = 0; k < 21; ++k) {
        EXPECT_EQ(soon.first()[k], k);
        EXPECT_EQ(soon.second()[k], 100 + k);
        EXPECT_EQ(soon.at(k), 2 * k);
    }
    for (std::int32_t k = 21; k < (21 + kBlock - 1) / kBlock * kBlock; ++k) {
        EXPECT_EQ(soon.first()[k], 20);
        EXPECT_EQ(soon.second()[k], 120);
    }
    EXPECT_TRUE(soon.has_room(9));
    EXPECT_FALSE(soon.has_room(60));
    EXPECT_FALSE(soon.are_all());
    soon.give_up();
    EXPECT_TRUE(soon.are_all());
    soon.begin(0, 1);
    soon.end();
    EXPECT_FALSE(soon.are_all());
    EXPECT_EQ(soon.size(), 0);
}

// Two grains that each move by half the gap may touch; until then, none that is left out can.
TEST(Soon, LastsUntilAPairThatIsLeftOutCouldTouch) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0, 1);
    for (int round = 0; round < 1000; ++round) {
        const double before = any(random), gap = 0.01 * any(random);
        Soon soon;
        soon.expire(1);
        EXPECT_FALSE(soon.lasts(0));
        soon.begin(before, gap);
        EXPECT_TRUE(soon.lasts(before));
        EXPECT_TRUE(soon.lasts(before + 0.4 * gap));
        for (const double share : {0.5, 0.51, 1.0, 30.0}) EXPECT_FALSE(soon.lasts(before + share * gap));
        soon.expire(1);
        EXPECT_FALSE(soon.lasts(before));
    }
}

}  // namespace
}  // namespace grainreel
