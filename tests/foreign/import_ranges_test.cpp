// Tests of the ranges of values of an imported run's grains.
#include <gtest/gtest.h>

#include <limits>

#include "engine/run/import/import_ranges.hpp"

namespace grainreel {
namespace {

TEST(TopOfMost, NinetyNineOfAHundredStayBelow) {
    TopOfMost top;
    for (int k = 1; k <= 1000; ++k) top.add(0.001 * k);
    EXPECT_GE(top.value(), 0.990);
    EXPECT_LE(top.value(), 0.990 * 1.024);
}

TEST(TopOfMost, OneThatIsFarOffDoesNotCount) {
    TopOfMost top;
    for (int k = 0; k < 999; ++k) top.add(2e-6);
    top.add(1e9);
    EXPECT_GE(top.value(), 2e-6);
    EXPECT_LE(top.value(), 2e-6 * 1.024);
}

TEST(TopOfMost, NothingAndNumbersThatAreNone) {
    TopOfMost top;
    EXPECT_EQ(top.value(), 0);
    for (const double odd :
         {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        top.add(odd);
    EXPECT_EQ(top.value(), 0);
    for (int k = 0; k < 100; ++k) top.add(0);
    top.add(5);
    EXPECT_EQ(top.value(), 0);
}

}  // namespace
}  // namespace grainreel
