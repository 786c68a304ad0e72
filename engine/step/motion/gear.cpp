// Gear's predictor-corrector method.
#include <cmath>

#include "engine/step/motion/integrate.hpp"

namespace grainreel {

namespace {

Vec3 acceleration(const Grains& grains, const KickInput& in, std::int32_t i) {
    return grains.motion[i].inverse_mass * grains.load[i].force + in.gravity;
}
Vec3 spin_acceleration(const Grains& grains, std::int32_t i) {
    return grains.motion[i].inverse_inertia * grains.load[i].torque;
}

// What drag leaves of a velocity or spin.
Vec3 dragged(Vec3 motion, double keep) {
    if (keep == 1) return motion;
    for (double& part : motion) {
        part *= keep;
        if (std::abs(part) < kNoMotion) part = 0;
    }
    return motion;
}

}  // namespace

void begin_derivatives(Grains& grains, const KickInput& in) {
    grains.derivatives.assign(grains.size(), {});
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(grains.size()); ++i) {
        grains.derivatives[i].acceleration = acceleration(grains, in, i);
        if (in.rubs) grains.derivatives[i].spin_acceleration = spin_acceleration(grains, i);
    }
}

Vec3 predict(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const double h = in.drift;
    Vec3 fastest(0, 0, 0);
    for (std::int32_t i = begin; i < end; ++i) {
        Derivatives& d = grains.derivatives[i];
        Vec3& v = grains.motion[i].velocity;
        const Vec3 mean = v + h / 2 * d.acceleration + h * h / 6 * d.jerk;
        grains.place[i].position += h * mean;
        fastest = fastest.cwiseMax((mean - in.frame).cwiseAbs());
        v += h * d.acceleration + h * h / 2 * d.jerk;
        d.acceleration += h * d.jerk;
        grains.load[i] = {};
        if (!in.rubs) continue;
        grains.motion[i].spin += h * d.spin_acceleration + h * h / 2 * d.spin_jerk;
        d.spin_acceleration += h * d.spin_jerk;
    }
    turn(grains, in, in.drift, begin, end);
    round_motion(grains, in, begin, end);
    return fastest;
}

// For the scaled derivatives h^k/k! d^k x/dt^k, Gear's coefficients are 1/6, 5/6, 1, 1/3 where a force gives
// the second derivative (positions), and 5/12, 1, 1/2 where a torque gives the first derivative (spins). So
// h^2/12 below is 1/6 of h^2/2, and 5 h/12 is 5/6 of h/2.
void correct(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const double h = in.drift;
    for (std::int32_t i = begin; i < end; ++i) {
        Derivatives& d = grains.derivatives[i];
        const Vec3 more = acceleration(grains, in, i) - d.acceleration;
        grains.place[i].position += h * h / 12 * more;
        grains.motion[i].velocity = dragged(grains.motion[i].velocity + 5 * h / 12 * more, in.keep);
        d.acceleration += more;
        d.jerk += more / h;
        if (!in.rubs) continue;
        const Vec3 faster = spin_acceleration(grains, i) - d.spin_acceleration;
        grains.motion[i].spin = dragged(grains.motion[i].spin + 5 * h / 12 * faster, in.keep);
        d.spin_acceleration += faster;
        d.spin_jerk += faster / h;
    }
}

}  // namespace grainreel
