#include "engine/state/wall_motion.hpp"

#include <cmath>
#include <numbers>

namespace grainreel {

WallMotion::WallMotion(const Drive& drive, const Clock& clock)
    : amplitude_(drive.present ? drive.amplitude : 0),
      angular_frequency_(2 * std::numbers::pi * drive.frequency),
      ramp_(drive.ramp),
      start_phase_(2 * std::numbers::pi * drive.phase),
      direction_(drive.direction),
      clock_(clock) {}

Pose WallMotion::at(std::int64_t step, double share_of_step) const {
    if (share_of_step == 1) return at(step + 1, 0);
    if (step < 0) return {};
    const double time = clock_.time(step) + share_of_step * clock_.step;
    if (!moving()) return {Vec3::Zero(), Vec3::Zero(), time};
    const double more =
        clock_.steps_per_period > 0 ? share_of_step / static_cast<double>(clock_.steps_per_period) : 0;
    const double angle = 2 * std::numbers::pi * (clock_.phase(step) + more);
    const double sine = std::sin(angle), cosine = std::cos(angle);
    double share = 1, share_rate = 0, start = 0;
    if (ramp_ > 0) {
        const double u = (clock_.cycles(step) + more) / ramp_;
        if (u < 1) {
            share = u * u * u * (10 + u * (6 * u - 15));
            share_rate = 30 * u * u * (1 - u) * (1 - u) * angular_frequency_ / (2 * std::numbers::pi * ramp_);
        }
    } else {
        start = std::sin(start_phase_);
    }
    const double offset = amplitude_ * (share * sine - start);
    const double velocity = amplitude_ * (share * angular_frequency_ * cosine + share_rate * sine);
    return {offset * direction_, velocity * direction_, time};
}

}  // namespace grainreel
