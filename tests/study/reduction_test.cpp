// Tests of reductions against results of their definitions, computed by hand.
#include "render/app/study/study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace grainreel {
namespace {

using Kind = Reduction::Kind;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> line(const std::vector<double>& times, double offset, double slope) {
    std::vector<double> values;
    for (const double t : times) values.push_back(offset + slope * t);
    return values;
}

const std::vector<double> uneven{0, 0.1, 0.25, 0.7, 1.5, 1.6};  // s

TEST(Reduction, SlopeOfALineIsItsOwn) {
    EXPECT_NEAR(slope_of(uneven, line(uneven, 3, -2.5)), -2.5, 1e-14);
    EXPECT_EQ(slope_of(uneven, line(uneven, 3, 0)), 0);
}

// The slope of t^2 at t = 0, 1, 2, 3 is sum (t - 3/2)(t^2 - 7/2) / sum (t - 3/2)^2 = 15 / 5.
TEST(Reduction, SlopeIsThatOfLeastSquares) {
    EXPECT_DOUBLE_EQ(slope_of({0, 1, 2, 3}, {0, 1, 4, 9}), 3);
}

// The squares of 1, 2, 3, 4 about 5/2 add up to 5, which is divided by n - 1 = 3. NaN and rows outside the
// window are left out.
TEST(Reduction, MaxMinAndDeviation) {
    const std::vector<double> times{0, 1, 2, 3, 4, 5}, values{-9, 1, 2, nan, 3, 4};
    const auto of = [&](Kind kind, double from) {
        Reduction how;
        how.kind = kind, how.from = from;
        return reduce(how, times, values);
    };
    EXPECT_EQ(of(Kind::max, 0), 4);
    EXPECT_EQ(of(Kind::min, 0), -9);
    EXPECT_EQ(of(Kind::min, 0.5), 1);
    EXPECT_DOUBLE_EQ(of(Kind::deviation, 0.5), std::sqrt(5.0 / 3));
    EXPECT_TRUE(std::isnan(of(Kind::deviation, 5)));
    EXPECT_TRUE(std::isnan(of(Kind::max, 6)));
}

TEST(Reduction, SlopeNeedsTwoTimes) {
    EXPECT_TRUE(std::isnan(slope_of({}, {})));
    EXPECT_TRUE(std::isnan(slope_of({1}, {2})));
}

// v = a + b t reaches the threshold at (threshold - a) / b, wherever the rows are.
TEST(Reduction, FirstPassageIsInterpolated) {
    for (const double slope : {2.0, -2.0}) {
        const double offset = -slope * 0.9;
        for (const double threshold : {-1.0, 0.3, 1.1}) {
            const double expected = (threshold - offset) / slope;
            EXPECT_NEAR(first_passage(threshold, uneven, line(uneven, offset, slope)), expected, 1e-14);
        }
    }
}

TEST(Reduction, FirstPassageAndLastCrossingDifferWhereTheValueComesBack) {
    const std::vector<double> times{0, 1, 2, 3, 4}, values{0, 2, 0, 2, 2};
    EXPECT_DOUBLE_EQ(first_passage(1, times, values), 0.5);
    EXPECT_DOUBLE_EQ(last_crossing(1, times, values), 2.5);
    EXPECT_DOUBLE_EQ(last_crossing(0.5, times, {0, 2, 0, 2, 0}), 3.75);
}

TEST(Reduction, ThresholdThatIsNotReachedGivesNothing) {
    EXPECT_TRUE(std::isnan(first_passage(5, uneven, line(uneven, 0, 1))));
    EXPECT_TRUE(std::isnan(last_crossing(5, uneven, line(uneven, 0, 1))));
    EXPECT_TRUE(std::isnan(first_passage(5, {}, {})));
    EXPECT_TRUE(std::isnan(last_crossing(5, {1}, {5})));
}

TEST(Reduction, ThresholdWhereTheValuesBegin) {
    EXPECT_EQ(first_passage(3, {2, 3}, {3, 4}), 2);
}

// The mean of t over 0.25 <= t <= 1.5 is (0.25 + 0.7 + 1.5) / 3.
TEST(Reduction, WindowTakesItsEnds) {
    EXPECT_DOUBLE_EQ(reduce({Kind::mean, 0.25, 1.5, 0}, uneven, uneven), (0.25 + 0.7 + 1.5) / 3);
    EXPECT_EQ(reduce({Kind::end, 0, 1.5, 0}, uneven, uneven), 1.5);
    EXPECT_EQ(reduce({Kind::end}, uneven, uneven), 1.6);
    EXPECT_TRUE(std::isnan(reduce({Kind::mean, 2, 3, 0}, uneven, uneven)));
    // 0.1 + 0.2 is slightly larger than 0.3, but means 0.3.
    EXPECT_EQ(reduce({Kind::end, 0, 0.3, 0}, {0, 0.1 + 0.2}, {1, 2}), 2);
    EXPECT_DOUBLE_EQ(reduce({Kind::slope, 0.1, 1.6, 0}, uneven, line(uneven, 1, 4)), 4);
    EXPECT_DOUBLE_EQ(reduce({Kind::first_passage, 1, 4, 1}, {0, 1, 2, 3, 4}, {0, 2, 0, 2, 2}), 1.5);
    EXPECT_DOUBLE_EQ(reduce({Kind::crossing, 0, 2, 1}, {0, 1, 2, 3, 4}, {0, 2, 0, 2, 2}), 1.5);
}

TEST(Reduction, ValuesThatAreMissingAreLeftOutButForTheLast) {
    EXPECT_EQ(reduce({Kind::mean}, {0, 1, 2}, {1, nan, 5}), 3);
    EXPECT_EQ(reduce({Kind::slope}, {0, 1, 2}, {1, nan, 5}), 2);
    EXPECT_DOUBLE_EQ(reduce({Kind::first_passage, 0, 9, 3}, {0, 1, 2}, {1, nan, 5}), 1);
    EXPECT_TRUE(std::isnan(reduce({Kind::end}, {0, 1, 2}, {1, 4, nan})));
}

}  // namespace
}  // namespace grainreel
