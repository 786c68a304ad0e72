// Numbers with twice the digits of a double: each is the sum of two doubles (Dekker 1971, Numer. Math. 18,
// 224). mathematics.hpp computes with them. They need rounding to nearest, and no fused multiplications,
// which would make the bits depend on the processor.
#pragma once

#include <cmath>

namespace grainreel {

struct DoubleDouble {
    double high = 0, low = 0;  // high is the sum, rounded to a double

    constexpr DoubleDouble() = default;
    constexpr DoubleDouble(double whole) : high(whole) {}
    constexpr DoubleDouble(double h, double l) : high(h), low(l) {}
};

// a + b without an error (Knuth).
constexpr DoubleDouble exact_sum(double a, double b) {
    const double sum = a + b, of_b = sum - a, of_a = sum - of_b;
    return {sum, (a - of_a) + (b - of_b)};
}

// The same for |a| >= |b|, or a = 0 (Dekker).
constexpr DoubleDouble exact_sum_ordered(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

// The first 26 digits of x (Veltkamp). |x| must be below 2^996.
constexpr double first_half_of(double x) {
    const double shifted = 0x8000001p0 * x;
    return shifted - (shifted - x);
}

// a b without an error, unless a number becomes too large or too small for a double (Dekker).
constexpr DoubleDouble exact_product(double a, double b) {
    const double product = a * b, a1 = first_half_of(a), b1 = first_half_of(b), a2 = a - a1, b2 = b - b1;
    return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

constexpr DoubleDouble operator-(const DoubleDouble& a) {
    return {-a.high, -a.low};
}
constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
    const DoubleDouble sum = exact_sum_ordered(high.high, high.low + low.high);
    return exact_sum_ordered(sum.high, sum.low + low.low);
}
constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + -b;
}
constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = exact_product(a.high, b.high);
    return exact_sum_ordered(p.high, p.low + (a.high * b.low + a.low * b.high));
}
constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const double second = (a - b * first).high / b.high;
    const double third = (a - b * first - b * second).high / b.high;
    return exact_sum_ordered(first, second) + third;
}

// The root of a number that is not negative.
inline DoubleDouble root_of(const DoubleDouble& a) {
    if (a.high <= 0) return 0;
    const double first = std::sqrt(a.high);
    return exact_sum_ordered(first, (a - exact_product(first, first)).high / (2 * first));
}

}  // namespace grainreel
