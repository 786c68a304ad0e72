#include "engine/scene/drive/drive_change.hpp"

#include <cmath>
#include <numbers>

#include "engine/base/numbers.hpp"

namespace grainreel {

DriveChange::Values DriveChange::at(double u) const {
    const double s = smooth_step::value(u), rate = smooth_step::slope(u) / duration,
                 rate2 = smooth_step::curvature(u) / (duration * duration);
    const double more_omega = 2 * std::numbers::pi * (frequency - frequency_before);
    const double more_acceleration = acceleration - acceleration_before;
    Values v{};
    v.omega = 2 * std::numbers::pi * frequency_before + more_omega * s;
    v.omega_rate = more_omega * rate;
    // a = A / w^2, and its derivatives by the chain rule.
    const double level = acceleration_before + more_acceleration * s, w2 = v.omega * v.omega;
    const double level_rate = more_acceleration * rate, level_rate2 = more_acceleration * rate2;
    const double growth = v.omega_rate / v.omega, omega_rate2 = more_omega * rate2;
    v.amplitude = level / w2;
    v.amplitude_rate = (level_rate - 2 * level * growth) / w2;
    v.amplitude_rate2 =
        (level_rate2 - 4 * level_rate * growth + level * (6 * growth * growth - 2 * omega_rate2 / v.omega)) /
        w2;
    return v;
}

// z = a sin p with p' = w: z' = a' sin p + a w cos p, z'' = (a'' - a w^2) sin p + (2 a' w + a w') cos p.
Envelope envelope_of(const DriveChange::Values& v) {
    return {v.amplitude, std::hypot(v.amplitude_rate, v.amplitude * v.omega),
            std::hypot(v.amplitude_rate2 - v.amplitude * v.omega * v.omega,
                       2 * v.amplitude_rate * v.omega + v.amplitude * v.omega_rate)};
}

}  // namespace grainreel
