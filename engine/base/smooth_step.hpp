// From 0 to 1 with neither a corner nor a jump of curvature: s(u) = 10 u^3 - 15 u^4 + 6 u^5 for u in [0, 1].
// s' and s'' vanish at both ends.
#pragma once

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
