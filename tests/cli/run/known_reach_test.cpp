// Tests of how high grains got, found by counting them.
#include "render/film/sources/recorded_scene.hpp"

#include <gtest/gtest.h>

namespace grainreel {
namespace {

// One in a hundred of 200 grains is two: the two highest grains do not count, and the third does.
TEST(KnownReach, LeavesOutOneGrainInAHundred) {
    State frame;
    for (int k = 0; k < 200; ++k) {
        frame.id.push_back(k);
        frame.radius.push_back(0.002);
        frame.position.emplace_back(0, 0, 0.0005 * k);
    }
    EXPECT_DOUBLE_EQ(*reach_of(frame), 0.0005 * 197 + 0.002);
    frame.position[5].z() = 3;  // with one more stray grain, one less of the others is left out
    EXPECT_DOUBLE_EQ(*reach_of(frame), 0.0005 * 198 + 0.002);
}

TEST(KnownReach, OfFewGrainsIsAllOfThem) {
    State frame;
    EXPECT_FALSE(reach_of(frame));
    frame.id = {0};
    frame.radius = {0.01};
    frame.position = {Vec3(0, 0, 0.5)};
    EXPECT_DOUBLE_EQ(*reach_of(frame), 0.51);
}

}  // namespace
}  // namespace grainreel
