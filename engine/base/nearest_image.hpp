// Lengths in a container that repeats.
#pragma once

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
