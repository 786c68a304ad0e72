// A steady turn about an axis, smoothly begun and ended.
#pragma once

#include <limits>

#include "engine/base/vector.hpp"

namespace grainreel {

// The rate rises from 0 to `rate` within `over` seconds from `from` on, as 10u^3 - 15u^4 + 6u^5, as the
// drive's ramp does, and falls back in the same way from `until` on.
struct BodyTurn {
    Vec3 axis{0, 0, 1};                                      // unit
    Vec3 through{0, 0, 0};                                   // m, a point of the axis
    double rate = 0;                                         // rad/s, by the right-hand rule
    double from = 0;                                         // s
    double over = 0;                                         // s; 0: at once
    double until = std::numeric_limits<double>::infinity();  // s

    double angle_at(double time) const;  // rad, since the start; exact integral of the rate
    double rate_at(double time) const;   // rad/s
    bool operator==(const BodyTurn&) const = default;
};

}  // namespace grainreel
