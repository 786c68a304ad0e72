// Tests of Student's t against closed forms and a printed table.
#include "engine/questions/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace grainreel {
namespace {

// With one degree of freedom T has Cauchy's distribution: P(|T| <= t) = 2/pi atan t. With two it is t /
// sqrt(2 + t^2).
TEST(Student, ClosedForms) {
    for (const double p : {0.1, 0.5, 0.9, 0.95, 0.999}) {
        EXPECT_NEAR(student_t(p, 1) / std::tan(std::numbers::pi * p / 2), 1, 1e-11) << p;
        EXPECT_NEAR(student_t(p, 2) / (p * std::sqrt(2 / (1 - p * p))), 1, 1e-11) << p;
    }
}

// NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, critical values of Student's t, column 0.975.
TEST(Student, PrintedTable) {
    const std::pair<int, double> table[] = {{1, 12.706}, {2, 4.303},  {3, 3.182},  {4, 2.776},  {5, 2.571},
                                            {6, 2.447},  {7, 2.365},  {8, 2.306},  {9, 2.262},  {10, 2.228},
                                            {15, 2.131}, {20, 2.086}, {29, 2.045}, {60, 2.000}, {100, 1.984}};
    for (const auto& [freedom, t] : table) EXPECT_NEAR(student_t(0.95, freedom), t, 5.01e-4) << freedom;
}

// For 1, 2, 3 s is 1, and t has two degrees of freedom.
TEST(Student, IntervalOfThree) {
    const MeanInterval interval = mean_interval({3, 1, 2});
    EXPECT_EQ(interval.count, 3u);
    EXPECT_DOUBLE_EQ(interval.mean, 2);
    EXPECT_NEAR(interval.half, 0.95 * std::sqrt(2 / (1 - 0.95 * 0.95)) / std::sqrt(3), 1e-12);
}

TEST(Student, FewValuesHaveNoInterval) {
    EXPECT_EQ(mean_interval({}).count, 0u);
    EXPECT_TRUE(std::isnan(mean_interval({}).mean));
    EXPECT_EQ(mean_interval({5}).mean, 5);
    EXPECT_TRUE(std::isnan(mean_interval({5}).half));
    const MeanInterval gaps = mean_interval({std::numeric_limits<double>::quiet_NaN(), 4, 4});
    EXPECT_EQ(gaps.count, 2u);
    EXPECT_EQ(gaps.mean, 4);
    EXPECT_EQ(gaps.half, 0);
}

}  // namespace
}  // namespace grainreel
