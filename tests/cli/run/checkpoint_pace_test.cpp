// Tests of how often a run writes checkpoints.
#include "engine/run/driver/pace.hpp"

#include <gtest/gtest.h>

namespace grainreel {
namespace {

TEST(CheckpointPace, TheFirstSecondsHaveOneAndLaterEveryHalfMinute) {
    CheckpointPace pace;
    for (const double interval : {2, 4, 8, 16, 30, 30}) {
        pace.saved(0);
        EXPECT_FALSE(pace.due(0.99 * interval));
        EXPECT_TRUE(pace.due(1.01 * interval));
    }
}

TEST(CheckpointPace, ACostlyOneTakesAtMostAHundredthOfTheTime) {
    CheckpointPace pace;
    pace.saved(3);
    EXPECT_FALSE(pace.due(100 * 3 - 1));
    EXPECT_TRUE(pace.due(100 * 3 + 1));
}

}  // namespace
}  // namespace grainreel
