#include "engine/step/integrate.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/integrate.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/vector/record-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Of grain i: position and radius, velocity and inverse mass, spin and inverse inertia; force and torque.
struct Numbers {
    double *place, *motion, *spin, *load;
    RoundedMotion* rounded;
    explicit Numbers(Grains& g)
        : place(reinterpret_cast<double*>(g.place.data())),
          motion(reinterpret_cast<double*>(g.motion.data())),
          spin(reinterpret_cast<double*>(g.spin.data())),
          load(reinterpret_cast<double*>(g.load.data())),
          rounded(g.rounded.empty() ? nullptr : g.rounded.data()) {}
};

// (x, x, x, fourth): kicks leave the fourth number of a record, its mass or inertia, as it is.
HWY_INLINE Record<4> first_three(double x, double fourth = 0) {
    return record_of(Vec3(x, x, x), fourth);
}

// A velocity or spin after a kick; `inverse`: its mass or inertia.
HWY_INLINE Record<4> kicked(const Record<4>& rate, const Record<4>& push, const Record<4>& inverse,
                            const Record<4>& extra, const Record<4>& time) {
    return rate + time * (push * inverse + extra);
}

// Whether a pass over the grains ends a step, begins one, or both.
template <bool ends, bool begins>
HWY_INLINE Vec3 pass(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Numbers at(grains);
    const Record<4> last = first_three(in.end_kick), next = first_three(in.begin_kick);
    const Record<4> whole = first_three(in.drift), nothing = record_of(0.0);
    const Record<4> gravity = record_of(in.gravity), frame = record_of(in.frame);
    const Record<4> keep = first_three(in.keep, 1);
    Record<4> fastest = nothing;
    for (std::ptrdiff_t i = begin; i < end; ++i) {
        double *motion = at.motion + 4 * i, *load = at.load + 8 * i;
        const Record<4> force = record_at<4>(load), inverse_mass = record_of(motion[3]);
        Record<4> velocity = record_at<4>(motion);
        if (ends) velocity = kicked(velocity, force, inverse_mass, gravity, last) * keep;
        if (begins) {
            velocity = kicked(velocity, force, inverse_mass, gravity, next);
            double* place = at.place + 4 * i;
            put(record_at<4>(place) + whole * velocity, place);
            put(nothing, load);
            const Record<4> relative = velocity - frame;
            fastest = larger_size(fastest, relative);
            if (at.rounded) put_rounded(relative, at.rounded[i].velocity);
        }
        put(velocity, motion);
        if (!in.rubs) continue;
        double* spin = at.spin + 4 * i;
        const Record<4> torque = record_at<4>(load + 4), inverse_inertia = record_of(spin[3]);
        Record<4> rate = record_at<4>(spin);
        if (ends) rate = kicked(rate, torque, inverse_inertia, nothing, last) * keep;
        if (begins) {
            rate = kicked(rate, torque, inverse_inertia, nothing, next);
            put(nothing, load + 4);
            if (at.rounded) put_rounded(rate, at.rounded[i].rate);
        }
        put(rate, spin);
    }
    HWY_ALIGN double f[4];
    put(fastest, f);
    return {f[0], f[1], f[2]};
}

Vec3 first_half(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<false, true>(grains, in, begin, end);
}

Vec3 second_half(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<true, false>(grains, in, begin, end);
}

Vec3 both_halves(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<true, true>(grains, in, begin, end);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

namespace {

// Rotates q by the angle rate * step about the rate's axis; q stays of unit length.
Quaternion turned(const Quaternion& q, const Vec3& rate, double step) {
    const double angle = rate.norm() * step;
    if (angle == 0) return q;
    return (Quaternion(Eigen::AngleAxisd(angle, rate.normalized())) * q).normalized();
}

void turn(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    if (!in.rubs || grains.orientation.empty()) return;
    for (std::int32_t i = begin; i < end; ++i) {
        grains.orientation[i] = turned(grains.orientation[i], grains.spin[i].rate, in.drift);
    }
}

}  // namespace

HWY_EXPORT(first_half);
HWY_EXPORT(second_half);
HWY_EXPORT(both_halves);

Vec3 kick_and_drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Vec3 fastest = HWY_DYNAMIC_DISPATCH(first_half)(grains, in, begin, end);
    turn(grains, in, begin, end);
    return fastest;
}

void kick(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    HWY_DYNAMIC_DISPATCH(second_half)(grains, in, begin, end);
}

Vec3 kick_and_go_on(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Vec3 fastest = HWY_DYNAMIC_DISPATCH(both_halves)(grains, in, begin, end);
    turn(grains, in, begin, end);
    return fastest;
}

void go_on(Grains& grains, GoOn& stretch, std::int32_t complete) {
    const std::int32_t end = std::min(complete, stretch.end);
    if (end <= stretch.next) return;
    stretch.fastest = stretch.fastest.cwiseMax(kick_and_go_on(grains, stretch.kicks, stretch.next, end));
    stretch.next = end;
}

void drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i)
        grains.place[i].position += in.drift * grains.motion[i].velocity;
    turn(grains, in, begin, end);
}

namespace {

Vec3 acceleration(const Grains& grains, const KickInput& in, std::int32_t i) {
    return grains.motion[i].inverse_mass * grains.load[i].force + in.gravity;
}
Vec3 spin_acceleration(const Grains& grains, std::int32_t i) {
    return grains.spin[i].inverse_inertia * grains.load[i].torque;
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
        grains.spin[i].rate += h * d.spin_acceleration + h * h / 2 * d.spin_jerk;
        d.spin_acceleration += h * d.spin_jerk;
    }
    turn(grains, in, begin, end);
    round_motion(grains, in, begin, end);
    return fastest;
}

void round_motion(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    if (grains.rounded.empty()) return;
    for (std::int32_t i = begin; i < end; ++i) {
        const Eigen::Vector3f velocity = (grains.motion[i].velocity - in.frame).cast<float>();
        const Eigen::Vector3f rate = grains.spin[i].rate.cast<float>();
        grains.rounded[i] = {{velocity.x(), velocity.y(), velocity.z()},
                             static_cast<float>(grains.motion[i].inverse_mass),
                             {rate.x(), rate.y(), rate.z()},
                             static_cast<float>(grains.spin[i].inverse_inertia)};
    }
}

// Coefficients 1/6, 5/6, 1, 1/3 for a force that gives the second derivative; 5/12, 1, 1/2 for a torque that
// gives the first.
void correct(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const double h = in.drift;
    for (std::int32_t i = begin; i < end; ++i) {
        Derivatives& d = grains.derivatives[i];
        const Vec3 more = acceleration(grains, in, i) - d.acceleration;
        grains.place[i].position += h * h / 12 * more;
        grains.motion[i].velocity = (grains.motion[i].velocity + 5 * h / 12 * more) * in.keep;
        d.acceleration += more;
        d.jerk += more / h;
        if (!in.rubs) continue;
        const Vec3 faster = spin_acceleration(grains, i) - d.spin_acceleration;
        grains.spin[i].rate = (grains.spin[i].rate + 5 * h / 12 * faster) * in.keep;
        d.spin_acceleration += faster;
        d.spin_jerk += faster / h;
    }
}

}  // namespace grainreel
#endif
