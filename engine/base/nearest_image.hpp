// Lengths in a container that repeats.
#pragma once

namespace grainreel {

// x shortened to the nearest image when the depth is periodic; period in m, 0 for none. |x| < 1.5 periods.
inline double nearest_image(double x, double period) {
    if (period > 0) {
        if (x > 0.5 * period) return x - period;
        if (x < -0.5 * period) return x + period;
    }
    return x;
}

}  // namespace grainreel
