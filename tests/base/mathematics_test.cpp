// Tests of engine/base/mathematics.hpp that need no other mathematics: special values, results that are
// exact, and bits that must be the same with every compiler and on every processor. tests/accuracy compares
// with MPFR.
#include "engine/base/mathematics.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace grainreel {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double least = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

// The same value and sign, or neighbours: where the C library's result is not exact, its last bit may be
// wrong.
void expect_as(double is, double should, const std::string& what) {
    if (std::isnan(should)) {
        EXPECT_TRUE(std::isnan(is)) << what << " is " << is;
        return;
    }
    EXPECT_EQ(std::signbit(is), std::signbit(should)) << what;
    EXPECT_TRUE(is == should || std::nextafter(should, infinity) == is ||
                std::nextafter(should, -infinity) == is)
        << what << " is " << is << ", not " << should;
}

std::vector<double> special_values() {
    std::vector<double> values{0,          least,   1e-310,     std::numeric_limits<double>::min(),
                               1e-200,     1e-20,   1.0 / 3,    0.5,
                               1,          1.5,     2,          3,
                               4,          7,       1023,       1024,
                               1074,       1075,    0x1p31,     0x1p52,
                               0x1p53 - 1, 0x1p53,  0x1p53 + 2, 1e20,
                               1e200,      largest, infinity};
    values.push_back(std::nextafter(1.0, 2.0));
    values.push_back(std::nextafter(1.0, 0.0));
    for (std::size_t k = 0, count = values.size(); k < count; ++k) values.push_back(-values[k]);
    values.push_back(no_number);
    return values;
}

TEST(Mathematics, SpecialValuesOfTwoArgumentsAreThoseOfC) {
    for (const double x : special_values())
        for (const double y : special_values()) {
            const std::string of = std::to_string(x) + ", " + std::to_string(y);
            expect_as(math::pow(x, y), std::pow(x, y), "pow " + of);
            expect_as(math::atan2(x, y), std::atan2(x, y), "atan2 " + of);
            expect_as(math::hypot(x, y), std::hypot(x, y), "hypot " + of);
        }
}

TEST(Mathematics, SpecialValuesOfOneArgumentAreThoseOfC) {
    for (const double x : special_values()) {
        const std::string of = std::to_string(x);
        expect_as(math::exp(x), std::exp(x), "exp " + of);
        expect_as(math::log(x), std::log(x), "log " + of);
        expect_as(math::log10(x), std::log10(x), "log10 " + of);
        expect_as(math::cbrt(x), std::cbrt(x), "cbrt " + of);
        expect_as(math::erfc(x), std::erfc(x), "erfc " + of);
        expect_as(math::asin(x), std::asin(x), "asin " + of);
        expect_as(math::acos(x), std::acos(x), "acos " + of);
        expect_as(math::atan(x), std::atan(x), "atan " + of);
        if (std::abs(x) > math::kLargestAngle && std::isfinite(x)) continue;
        expect_as(math::sin(x), std::sin(x), "sin " + of);
        expect_as(math::cos(x), std::cos(x), "cos " + of);
        expect_as(math::tan(x), std::tan(x), "tan " + of);
    }
}

TEST(Mathematics, AnglesBeyondTheLimitHaveNoSine) {
    EXPECT_FALSE(std::isnan(math::sin(math::kLargestAngle)));
    const double beyond = std::nextafter(math::kLargestAngle, infinity);
    for (const double angle : {beyond, -beyond, largest}) {
        EXPECT_TRUE(std::isnan(math::sin(angle)) && std::isnan(math::cos(angle)) &&
                    std::isnan(math::tan(angle)));
        EXPECT_TRUE(std::isnan(math::sin_cos(angle).sine) && std::isnan(math::sin_cos(angle).cosine));
    }
}

TEST(Mathematics, ExactResultsAreExact) {
    for (int n = 0; n <= 22; ++n) {
        double power_of_ten = 1;
        for (int k = 0; k < n; ++k) power_of_ten *= 10;
        EXPECT_EQ(math::pow(10, n), power_of_ten) << n;
        EXPECT_EQ(math::log10(power_of_ten), n) << n;
    }
    for (int n = -1074; n <= 1023; ++n) {
        EXPECT_EQ(math::pow(2, n), std::ldexp(1, n)) << n;
        EXPECT_EQ(math::pow(std::ldexp(1, n), 0.5), std::sqrt(std::ldexp(1, n))) << n;
        EXPECT_EQ(math::power_of_two_up_to(std::ldexp(1, n)), std::ldexp(1, n));
        EXPECT_EQ(math::power_of_two_from(std::ldexp(1, n)), std::ldexp(1, n));
    }
    for (int n = 1; n <= 1000; ++n) {
        const double x = n;
        EXPECT_EQ(math::cbrt(x * x * x), x);
        EXPECT_EQ(math::cbrt(-x * x * x * 0x1p-900), -x * 0x1p-300);
        EXPECT_EQ(math::pow(x, 3), x * x * x);
        EXPECT_EQ(math::pow(x, -1), 1 / x);
        EXPECT_EQ(math::hypot(3 * x, -4 * x), 5 * x);
        EXPECT_EQ(math::hypot(5 * x * 0x1p1000, 12 * x * 0x1p1000), 13 * x * 0x1p1000);
    }
    EXPECT_EQ(math::power_of_two_up_to(5), 4);
    EXPECT_EQ(math::power_of_two_from(5), 8);
    EXPECT_EQ(math::square(-3), 9);
    EXPECT_EQ(math::cube(-3), -27);
    EXPECT_EQ(math::acos(-1), std::numbers::pi);
    EXPECT_EQ(math::atan2(0, -1), std::numbers::pi);
    EXPECT_EQ(math::exp(1), std::numbers::e);
    EXPECT_EQ(math::log(2), std::numbers::ln2);
}

TEST(Mathematics, SineAndCosineTogetherHaveTheSameBits) {
    std::mt19937_64 random(1);
    for (int k = 0; k < 100000; ++k) {
        const double angle =
            std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -k % 90 - 13);
        const auto [sine, cosine] = math::sin_cos(angle);
        ASSERT_EQ(sine, math::sin(angle)) << angle;
        ASSERT_EQ(cosine, math::cos(angle)) << angle;
    }
}

// Folds the bits of results into one number.
class Bits {
  public:
    void add(double x) {
        fold_ = (std::rotl(fold_, 7) ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15;
    }
    std::uint64_t fold() const { return fold_; }

  private:
    std::uint64_t fold_ = 0;
};

// No compiler and no processor may give other bits. If a function changes on purpose, so do runs; then this
// number changes too, with the hashes of golden_test.cpp.
TEST(Mathematics, BitsAreTheSameEverywhere) {
    std::mt19937_64 random(2);
    Bits bits;
    for (int k = 0; k < 20000; ++k) {
        const double x = static_cast<double>(random() >> 11) * 0x1p-53, y = 40 * x - 20;
        const double z = std::ldexp(x, static_cast<int>(random() % 1000) - 500);
        for (const double result :
             {math::sin(y), math::cos(1e6 * y), math::tan(1e13 * y), math::asin(x), math::acos(x),
              math::atan(y), math::atan2(y, x - 0.5), math::exp(30 * y), math::log(z), math::log10(z),
              math::pow(x, y), math::pow(z, x), math::erfc(y), math::cbrt(z), math::hypot(z, y)})
            bits.add(result);
    }
    EXPECT_EQ(bits.fold(), 0x859ea9e10d14701c) << std::hex << "now 0x" << bits.fold();
}

}  // namespace
}  // namespace grainreel
