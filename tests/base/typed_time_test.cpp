// Typed times and the moments that they mean.
#include "engine/base/typed_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grainreel {
namespace {

using testing::ElementsAre;

// Moments at the whole steps next to 0, 0.1, ... 1 s.
std::vector<double> moments_each_tenth(double step) {
    std::vector<double> times;
    for (int k = 0; k <= 10; ++k) times.push_back(std::round(0.1 * k / step) * step);
    return times;
}

TEST(TypedTime, MeansTheMomentAtTheNearestStep) {
    for (const double step : {1.7e-5, 3e-4, 7e-3, 0.03}) {
        const std::vector<double> times = moments_each_tenth(step);
        EXPECT_THAT(typed_span(times, step, 0.3, 0.7), ElementsAre(3, 4, 5, 6, 7)) << step;
        EXPECT_THAT(typed_span(times, step, 0.1, 0.1), ElementsAre(1)) << step;
        EXPECT_THAT(typed_span(times, step, std::nullopt, 1.0), testing::SizeIs(11)) << step;
        EXPECT_THAT(typed_span(times, step, 1.0, std::nullopt), ElementsAre(10)) << step;
    }
}

TEST(TypedTime, NeedsNoStep) {
    const std::vector<double> times = moments_each_tenth(1.7e-5);
    EXPECT_THAT(typed_span(times, 0, 0.3, 0.7), ElementsAre(3, 4, 5, 6, 7));
}

// A message shows 123.4567 s as 123.457.
TEST(TypedTime, MayComeFromAMessage) {
    const std::vector<double> times{123.4467, 123.4567, 123.4667};
    EXPECT_THAT(typed_span(times, 1e-6, 123.457, 123.457), ElementsAre(1));
}

TEST(TypedTime, TakesNoNeighbour) {
    EXPECT_THAT(typed_span({0, 0.1, 0.2, 0.3}, 1e-4, 0.11, 0.29), ElementsAre(2));
    // A moment each step: times between two moments mean both at most.
    EXPECT_THAT(typed_span({0, 1, 2, 3}, 1, 1.2, 1.3), ElementsAre(1));
    EXPECT_THAT(typed_span({5}, 0, 4.0, std::nullopt), ElementsAre(0));
    EXPECT_THAT(typed_span({5}, 0, 5.1, std::nullopt), ElementsAre());
}

}  // namespace
}  // namespace grainreel
