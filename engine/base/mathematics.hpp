// Sines, exponential functions, logarithms, powers and roots with the same bits on every processor and with
// every C library. They use no more than the operations that IEEE 754 rounds correctly. engine/ calls none of
// the C library's (the test Calls): its bits differ between versions and processors.
//
// Names, arguments and special values (zeros, infinities, NaN) are those of <cmath>, but nothing touches
// errno or the floating-point flags. Functions that IEEE 754 defines exactly stay those of <cmath>: sqrt,
// fma, fmod, remainder, floor, ceil, round, nearbyint, frexp, ldexp.
//
// Largest errors found, in units of the last place (half a unit is the least possible):
//     sin 0.503   asin 0.501    atan  0.501   exp 0.506   log   0.501   cbrt  0.501
//     cos 0.503   acos 0.501    atan2 0.501   pow 0.511   log10 0.501   hypot 0.501
//     tan 0.501                                                         erfc  0.501
// build/release/tests/test_accuracy prints them (100,000 arguments of each of two to six kinds, compared with
// MPFR).
#pragma once

namespace grainreel::math {

// Angles are in radians. NaN beyond 2^50 = 1.1e15, where neighbouring doubles are a quarter of a radian
// apart.
constexpr double kLargestAngle = 0x1p50;
double sin(double angle);
double cos(double angle);
double tan(double angle);

struct SineCosine {
    double sine, cosine;
};
SineCosine sin_cos(double angle);  // both, with the same bits as one by one, for less than the price of two

double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);

double exp(double x);
double log(double x);
double log10(double x);
double pow(double base, double exponent);
double erfc(double x);  // 1 - erf(x)
double cbrt(double x);
double hypot(double x, double y);

// The largest power of two that is not above x, and the smallest that is not below it. x must be positive.
double power_of_two_up_to(double x);
double power_of_two_from(double x);

constexpr double square(double x) {
    return x * x;
}
constexpr double cube(double x) {
    return x * x * x;
}

}  // namespace grainreel::math
