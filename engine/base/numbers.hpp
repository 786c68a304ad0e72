// Lengths in a container that repeats.
#pragma once

#include <algorithm>
#include <cmath>

namespace grainreel {

// x shortened to the nearest image when the depth is periodic; period in m, 0 for none. |x| < 1.5 periods.
inline double nearest_image(double x, double period) {
    if (period > 0) {
        if (x > 0.5 * period) return x - period;
        if (x < -0.5 * period) return x + period;
    }
    return x;
}

// x wherever it is; the same number as nearest_image() has where that holds.
inline double wrapped(double x, double period) {
    if (period > 0 && std::abs(x) > 1.5 * period) return std::remainder(x, period);
    return nearest_image(x, period);
}

}  // namespace grainreel

// From 0 to 1 with neither a corner nor a jump of curvature: s(u) = 10 u^3 - 15 u^4 + 6 u^5 for u in [0, 1].
// s' and s'' vanish at both ends.

namespace grainreel::smooth_step {

inline double value(double u) {
    return u * u * u * (10 + u * (6 * u - 15));
}
inline double slope(double u) {
    return 30 * u * u * (1 - u) * (1 - u);
}
inline double curvature(double u) {
    return 60 * u * (1 - u) * (1 - 2 * u);
}
// Integral of s from 0 to u; 1/2 at u = 1.
inline double area(double u) {
    return u * u * u * u * (2.5 + u * (u - 3));
}

}  // namespace grainreel::smooth_step
namespace grainreel {

// Comparisons of numbers that a user wrote in decimals and units. "5.6 mm" is not 2.5 times "2.24 mm" to the
// last bit, nor is every number of millimetres that of its metres; what was meant to be equal is.

constexpr double kSameDecimals = 1e-9;  // relative

// How far two numbers of this size may differ and mean the same.
inline double slack_of(double a, double b) {
    return kSameDecimals * std::max(std::abs(a), std::abs(b));
}
inline bool clearly_less(double a, double b) {
    return a < b - slack_of(a, b);
}
inline bool clearly_more(double a, double b) {
    return clearly_less(b, a);
}

}  // namespace grainreel
