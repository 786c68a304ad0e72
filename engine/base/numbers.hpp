// Small functions of numbers: lengths in a container that repeats, a smooth step from 0 to 1, and comparisons
// of numbers that a user wrote. Keep this header light: hot code includes it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainreel {

// A number that is not known, or that there is none of.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The difference x of two coordinates, taken to the nearest periodic image. period: m, 0 where nothing
// repeats. |x| must be less than 1.5 periods.
inline double nearest_image(double x, double period) {
    if (period > 0) {
        if (x > 0.5 * period) return x - period;
        if (x < -0.5 * period) return x + period;
    }
    return x;
}

// The same for any x. Where |x| < 1.5 periods, the result has the same bits as that of nearest_image().
inline double wrapped(double x, double period) {
    if (period > 0 && std::abs(x) > 1.5 * period) return std::remainder(x, period);
    return nearest_image(x, period);
}

}  // namespace grainreel

// A step from 0 to 1 without a corner or a jump of curvature: s(u) = 10 u^3 - 15 u^4 + 6 u^5 for u in [0, 1].
// s' and s'' are 0 at both ends.
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
// The integral of s from 0 to u, which is 1/2 at u = 1.
inline double area(double u) {
    return u * u * u * u * (2.5 + u * (u - 3));
}

}  // namespace grainreel::smooth_step
namespace grainreel {

// Comparisons of numbers that a user wrote in decimals and units. "5.6 mm" is 2.5 times "2.24 mm", but not to
// the last bit. Numbers that differ only by rounding count as equal here.

constexpr double kSameDecimals = 1e-9;  // relative

// How far two numbers of this size may differ and still count as equal.
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
