// Exponential function, logarithms, powers and roots.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/base/double_double.hpp"
#include "engine/base/mathematics.hpp"

namespace grainreel::math {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr DoubleDouble kLog2(0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56);

// 2^exponent, for exponents from -1022 to 1023.
constexpr double two_to(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// x 2^exponent, rounded once, for x in about [1/100, 2].
double scaled(DoubleDouble x, int exponent) {
    if (exponent > 1024) return x.high * infinity;
    if (exponent > -900) return x.high * two_to(exponent - 1) * 2;
    int above_one;
    std::frexp(x.high, &above_one), --above_one;
    x = {x.high * two_to(-above_one), x.low * two_to(-above_one)}, exponent += above_one;  // now in [1, 2)
    if (exponent >= -1022) return x.high * two_to(exponent);
    if (exponent < -1080) return 0;
    // The result has fewer digits. Beside a number this large, x loses the others.
    const double large = two_to(-1022 - exponent);
    const DoubleDouble sum = exact_sum_ordered(large, x.high);
    return (sum.high + (sum.low + x.low) - large) * two_to(exponent + 100) * 0x1p-100;
}

// The exponential function: e^x = 2^k 2^(i/128) e^r, with |r| <= log(2) / 256. The table holds the second
// factor, and Taylor's series gives the third.

constexpr int kSteps = 128;

constexpr std::array<DoubleDouble, kSteps> powers_of_two() {
    const DoubleDouble x = kLog2 / kSteps;
    DoubleDouble root = 1;  // 2^(1/128)
    for (int n = 14; n > 0; --n) root = DoubleDouble(1) + root * x / n;
    std::array<DoubleDouble, kSteps> powers{DoubleDouble(1)};
    for (int i = 1; i < kSteps; ++i) powers[i] = powers[i - 1] * root;
    return powers;
}
constexpr std::array<DoubleDouble, kSteps> kPowersOfTwo = powers_of_two();

struct LongExponential {
    DoubleDouble value;  // in about [1, 2]
    int exponent;        // of two, by which it is multiplied
};

// For |x| up to about 750.
LongExponential long_exponential_of(const DoubleDouble& x) {
    // log(2) / 128 in two parts. The first has 35 digits, so that its products with n are exact.
    constexpr double first = 0x1.62e42fef8p-8, second = 0x1.1cf79abc9e3b3p-43;
    constexpr double to_whole = 0x1.8p52;  // adding it rounds to a whole number
    const double n = (x.high * (kSteps / kLog2.high) + to_whole) - to_whole;
    const double r = ((x.high - n * first) - n * second) + x.low;
    const double growth =
        r + r * r * (1.0 / 2 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120 + r * (1.0 / 720)))));
    const int whole = static_cast<int>(n);
    const DoubleDouble& power = kPowersOfTwo[whole & (kSteps - 1)];
    return {exact_sum_ordered(power.high, power.low + power.high * growth), whole >> 7};
}

double exponential_of(const DoubleDouble& x) {
    if (x.high > 710) return infinity;
    if (x.high < -746) return 0;
    const LongExponential of_x = long_exponential_of(x);
    return scaled(of_x.value, of_x.exponent);
}

// The logarithm: x = 2^k z, z in [11/16, 11/8). A table holds numbers c near 1 / z with few digits, and
// -log(c), so that log(x) = k log(2) - log(c) + log(1 + r) with r = c z - 1. Beside 1, c is 1, so that
// nothing cancels there.

struct NearInverse {
    double inverse;
    DoubleDouble logarithm;  // of 1 / inverse
};

constexpr std::uint64_t kLowestBits = std::bit_cast<std::uint64_t>(11.0 / 16);
constexpr int kShift = 52 - 7;  // 2^7 = kSteps stretches of z

// log(1 / c) = 2 artanh((1 - c) / (1 + c))
constexpr DoubleDouble logarithm_of_inverse(double c) {
    const DoubleDouble s = exact_sum(1, -c) / exact_sum(1, c), square = s * s;
    DoubleDouble sum = 0;
    for (int n = 45; n > 0; n -= 2) sum = DoubleDouble(1) / n + square * sum;
    return s * sum * 2;
}

constexpr std::array<NearInverse, kSteps> near_inverses() {
    std::array<NearInverse, kSteps> all{};
    for (int i = 0; i < kSteps; ++i) {
        const std::uint64_t begin = kLowestBits + (static_cast<std::uint64_t>(i) << kShift);
        const double from = std::bit_cast<double>(begin),
                     to = std::bit_cast<double>(begin + (std::uint64_t{1} << kShift));
        const double inverse = from == 1 || to == 1 ? 1 : static_cast<int>(1024 / (from + to) + 0.5) / 512.0;
        all[i] = {inverse, logarithm_of_inverse(inverse)};
    }
    return all;
}
constexpr std::array<NearInverse, kSteps> kNearInverses = near_inverses();

// log(1 + r) - r + r^2 / 2 for |r| <= 1/128, by Taylor's series.
double third_order_logarithm(double r) {
    const double r2 = r * r;
    const double ends = (1.0 / 7 - r * (1.0 / 8)) + r2 * (1.0 / 9 - r * (1.0 / 10));
    return r * r2 * ((1.0 / 3 - r * (1.0 / 4)) + r2 * ((1.0 / 5 - r * (1.0 / 6)) + r2 * ends));
}

// For 0 < x < infinity. The relative error is below 2^-67.
DoubleDouble logarithm_of(double x) {
    constexpr double smallest = std::numeric_limits<double>::min();
    const bool denormal = x < smallest;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(denormal ? x * 0x1p54 : x);
    const std::uint64_t above = bits - kLowestBits;
    const std::int64_t exponent = static_cast<std::int64_t>(above) >> 52;
    const double k = static_cast<double>(denormal ? exponent - 54 : exponent);
    const NearInverse& near = kNearInverses[above >> kShift & (kSteps - 1)];
    const std::uint64_t z = bits - (static_cast<std::uint64_t>(exponent) << 52);
    const double z1 = std::bit_cast<double>(z & ~std::uint64_t{0x3fffff}), z2 = std::bit_cast<double>(z) - z1;
    // Both products are exact, because the inverse has at most 10 digits.
    const DoubleDouble r = exact_sum(near.inverse * z1 - 1, near.inverse * z2);
    const DoubleDouble square = exact_product(r.high, r.high);
    // log(2) in two parts. The first has 42 digits, so that its products with k are exact.
    constexpr double first = 0x1.62e42fefa38p-1, second = 0x1.ef35793c7673p-45;
    const DoubleDouble one = exact_sum(k * first, near.logarithm.high);
    const DoubleDouble two = exact_sum(one.high, r.high);
    const DoubleDouble three = exact_sum(two.high, -0.5 * square.high);
    const double tail = third_order_logarithm(r.high) - (0.5 * square.low + r.high * r.low) + r.low;
    const double rest = (one.low + two.low + three.low) + (k * second + near.logarithm.low);
    return exact_sum(three.high, rest + tail);
}

bool is_whole(double x) {
    return std::floor(x) == x;
}
bool is_odd(double x) {
    return std::abs(x) < 0x1p53 && is_whole(x) && std::fmod(x, 2) != 0;
}

// base^exponent for a base that is neither negative nor NaN.
double power_of_size(double base, double exponent) {
    if (base == 1) return 1;
    const double at_the_end = (base > 1) == (exponent > 0) ? infinity : 0;
    if (base == 0 || std::isinf(base) || std::abs(exponent) > 0x1p66) return at_the_end;
    const DoubleDouble logarithm = logarithm_of(base), product = exact_product(exponent, logarithm.high);
    return exponential_of(exact_sum_ordered(product.high, product.low + exponent * logarithm.low));
}

}  // namespace

double exp(double x) {
    return std::isnan(x) ? x : exponential_of(x);
}

double log(double x) {
    if (!(x > 0)) return x == 0 ? -infinity : no_number;
    return x == infinity ? x : logarithm_of(x).high;
}

double log10(double x) {
    constexpr DoubleDouble of_ten(0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57);  // 1 / log(10)
    if (!(x > 0)) return x == 0 ? -infinity : no_number;
    return x == infinity ? x : (logarithm_of(x) * of_ten).high;
}

double pow(double base, double exponent) {
    if (exponent == 0 || base == 1) return 1;
    if (std::isnan(base) || std::isnan(exponent)) return no_number;
    if (!std::signbit(base)) return power_of_size(base, exponent);
    if (is_odd(exponent)) return -power_of_size(-base, exponent);
    const bool has_power = is_whole(exponent) || base == 0 || std::isinf(base);
    return has_power ? power_of_size(-base, exponent) : no_number;
}

// By the series of erf(x) (Abramowitz & Stegun 1964, 7.1.5) for |x| < 1, and else by the continued fraction
// of Laplace (7.1.14), which needs some 250 terms at 1, and fewer beyond.
double erfc(double x) {
    constexpr DoubleDouble root_of_pi(0x1.c5bf891b4ef6bp+0, -0x1.618f13eb7ca89p-54);
    if (std::isnan(x)) return x;
    if (std::abs(x) < 1) {
        const DoubleDouble square = exact_product(x, x);
        DoubleDouble sum = 0;
        for (int n = 30; n > 0; --n) sum = square / n * (DoubleDouble(-1) / (2 * n + 1) - sum);
        return (DoubleDouble(1) - DoubleDouble(2 * x) / root_of_pi * (DoubleDouble(1) + sum)).high;
    }
    const double size = std::abs(x);
    if (size > 28 || x < -6) return x > 0 ? 0 : 2;
    DoubleDouble fraction = size;
    for (int n = static_cast<int>(20 + 240 / (size * size)); n > 0; --n)
        fraction = DoubleDouble(size) + DoubleDouble(0.5 * n) / fraction;
    const LongExponential bell = long_exponential_of(-exact_product(size, size));
    const DoubleDouble part = bell.value / (root_of_pi * fraction);
    if (x > 0) return scaled(part, bell.exponent);
    return (DoubleDouble(2) - part * two_to(bell.exponent)).high;
}

double cbrt(double x) {
    if (x == 0 || !std::isfinite(x)) return x;
    int exponent;
    double m = std::frexp(std::abs(x), &exponent);
    const int third = exponent >= 0 ? (exponent + 2) / 3 : exponent / 3;
    m = std::ldexp(m, exponent - 3 * third);  // in [1/8, 1)
    double root = 0.45 + 0.57 * m;
    for (int k = 0; k < 3; ++k) {  // Halley's method, which triples the digits
        const double cubed = cube(root);
        root *= (cubed + 2 * m) / (2 * cubed + m);
    }
    const double rest = (DoubleDouble(m) - exact_product(root, root) * root).high;
    return std::copysign(std::ldexp(root + rest / (3 * root * root), third), x);
}

double power_of_two_up_to(double x) {
    int exponent;
    std::frexp(x, &exponent);
    return std::ldexp(1, exponent - 1);
}

double power_of_two_from(double x) {
    const double below = power_of_two_up_to(x);
    return below == x ? x : 2 * below;
}

double hypot(double x, double y) {
    const double larger = std::fmax(std::abs(x), std::abs(y)), smaller = std::fmin(std::abs(x), std::abs(y));
    if (std::isinf(larger)) return infinity;
    if (std::isnan(x) || std::isnan(y)) return no_number;
    int exponent, exponent_of_smaller;
    const double a = std::frexp(larger, &exponent);
    std::frexp(smaller, &exponent_of_smaller);
    if (smaller == 0 || exponent - exponent_of_smaller > 64) return larger;
    const double b = std::ldexp(smaller, -exponent);
    return scaled(root_of(exact_product(a, a) + exact_product(b, b)), exponent);
}

}  // namespace grainreel::math
