// Velocity Verlet (Swope et al. 1982): half a kick and a drift before the forces, half a kick after them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/state/grains.hpp"

namespace grainreel {

// Rotates q by the angle rate * step about the rate's axis; q stays of unit length.
inline Quaternion turned(const Quaternion& q, const Vec3& rate, double step) {
    const double angle = rate.norm() * step;
    if (angle == 0) return q;
    return (Quaternion(Eigen::AngleAxisd(angle, rate.normalized())) * q).normalized();
}

// First half for the grains [begin, end): v and w to the middle of the step, x to its end. Returns the
// largest squared displacement from `listed_at` + `drift`, m2.
template <bool rubs, bool predicts>
double kick_and_drift(Grains& grains, const std::vector<Vec3>& listed_at, const Vec3& drift,
                      const Vec3& gravity, double step, std::int32_t begin, std::int32_t end) {
    const double half = 0.5 * step;
    double farthest = 0;
    for (std::int32_t i = begin; i < end; ++i) {
        Motion& m = grains.motion[i];
        const Vec3 half_kick = half * (grains.force[i] * m.inverse_mass + gravity);
        m.velocity += half_kick;
        if constexpr (predicts) grains.end_velocity[i] = m.velocity + half_kick;
        grains.place[i].position += step * m.velocity;
        farthest = std::max(farthest, (grains.place[i].position - listed_at[i] - drift).squaredNorm());
        if constexpr (rubs) {
            Spin& s = grains.spin[i];
            const Vec3 half_turn = (half * s.inverse_inertia) * grains.torque[i];
            s.rate += half_turn;
            if constexpr (predicts) grains.end_spin[i] = s.rate + half_turn;
        }
    }
    if (rubs && !grains.orientation.empty()) {
        for (std::int32_t i = begin; i < end; ++i) {
            grains.orientation[i] = turned(grains.orientation[i], grains.spin[i].rate, step);
        }
    }
    return farthest;
}

// Second half: v and w to the end of the step. `keep` scales them, 1 without drag.
template <bool rubs>
void kick(Grains& grains, const Vec3& gravity, double step, double keep, std::int32_t begin,
          std::int32_t end) {
    const double half = 0.5 * step;
    for (std::int32_t i = begin; i < end; ++i) {
        Motion& m = grains.motion[i];
        m.velocity += half * (grains.force[i] * m.inverse_mass + gravity);
        if constexpr (rubs) {
            Spin& s = grains.spin[i];
            s.rate += (half * s.inverse_inertia) * grains.torque[i];
        }
    }
    if (keep == 1) return;
    for (std::int32_t i = begin; i < end; ++i) {
        grains.motion[i].velocity *= keep;
        grains.spin[i].rate *= keep;
    }
}

}  // namespace grainreel
