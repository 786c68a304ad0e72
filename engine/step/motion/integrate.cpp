#include "engine/step/motion/integrate.hpp"

#include "engine/base/rotation.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/motion/integrate.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/motion/kicks-inl.hpp"
#include "engine/vector/bundle-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

constexpr std::uint64_t kAllTogether = (1 << kTogether) - 1;

// The grains' numbers as arrays: position and radius; motion; force and torque. Grain i's place starts at
// place + 4 i, the others at 8 i.
struct Numbers {
    double *place, *motion, *load;
    float* rounded;
    const Loaded* loaded;
    const std::uint64_t otherwise;
    bool large;
    Numbers(Grains& g, const KickInput& in)
        : place(reinterpret_cast<double*>(g.place.data())),
          motion(reinterpret_cast<double*>(g.motion.data())),
          load(reinterpret_cast<double*>(g.load.data())),
          rounded(g.rounded.empty() ? nullptr : reinterpret_cast<float*>(g.rounded.data())),
          loaded(in.loaded && in.loaded->few() ? in.loaded : nullptr),
          otherwise(in.unloaded ? 0 : ~std::uint64_t{0}),
          large(g.size() >= kLargeBed) {}

    // Bit k says whether grain i + k may have a load.
    HWY_INLINE std::uint64_t loads_from(std::ptrdiff_t i) const {
        return loaded ? loaded->from(static_cast<std::int32_t>(i)) : otherwise;
    }

    // Fetches kTogether grains that lie some way ahead of grain i. `loads` are the bits of loads_from(i). In
    // a large bed everything is fetched. In a small bed contacts have brought it into the cache already,
    // except the motion where contacts read its rounded copy.
    HWY_INLINE void fetch_ahead(std::ptrdiff_t i, std::uint64_t loads) const {
        constexpr std::ptrdiff_t ahead = 32;
        if (!large && !rounded) return;
        const std::ptrdiff_t later = i + ahead;
        for (std::ptrdiff_t k = later; k < later + kTogether; ++k) __builtin_prefetch(motion + 8 * k, 1);
        if (!large) return;
        for (std::ptrdiff_t k = later; k < later + kTogether; k += 2) __builtin_prefetch(place + 4 * k, 1);
        if (rounded)
            for (std::ptrdiff_t k = later; k < later + kTogether; k += 2)
                __builtin_prefetch(rounded + 8 * k, 1);
        if ((loads >> ahead & kAllTogether) == 0) return;
        for (std::ptrdiff_t k = later; k < later + kTogether; ++k) __builtin_prefetch(load + 8 * k, 1);
    }
};

// The part of motion and load that a pass works on: velocity and force. With friction, spin and torque
// follow.
template <bool rubs>
struct MotionRecord {
    static constexpr int size = rubs ? 8 : 4;
    static HWY_INLINE Bundle<size> of(const Bundle<4>& first, const Bundle<4>& second) {
        if constexpr (rubs)
            return both(first, second);
        else
            return first;
    }
    // (x, x, x, fourth), twice. With fourth = 0 a kick leaves mass and inertia as they are.
    static HWY_INLINE Bundle<size> of(double x, double fourth = 0) {
        const Bundle<4> four = bundle_of(Vec3(x, x, x), fourth);
        return of(four, four);
    }
    // Velocity, spin and radius: the bundle that mixed precision reads.
    static HWY_INLINE Bundle<8> with_radius(const Bundle<size>& motion, double radius) {
        if constexpr (rubs)
            return with_last(motion, radius);
        else
            return both(motion, with_last(bundle_of(0.0), radius));
    }
    // Fills each half of the record with its own fourth number.
    static HWY_INLINE Bundle<size> fourths(const double* from) {
        return of(bundle_of(from[3]), bundle_of(from[7]));
    }
};

// A pass over the grains that ends a step, begins one, or does both. With `closes` there is a drift between
// the two. That drift and the next one are added one after the other, so that a run in pieces has the bits of
// a run in one piece.
template <bool ends, bool begins, bool closes, bool rubs, bool drags>
HWY_INLINE Vec3 pass_of(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    using Whole = MotionRecord<rubs>;
    constexpr int size = Whole::size;
    const Numbers at(grains, in);
    const Bundle<4> zero = bundle_of(0.0), whole = bundle_of(Vec3(in.drift, in.drift, in.drift));
    const Bundle<4> closing = bundle_of(Vec3(in.closing_drift, in.closing_drift, in.closing_drift));
    const Kicks<Bundle<size>> kicks{Whole::of(in.end_kick), Whole::of(in.begin_kick), Whole::of(in.keep, 1)};
    const Bundle<size> nothing = Whole::of(zero, zero);
    const Vec3 no_minus_zero = in.gravity + Vec3::Zero();  // the same bits as with a load of zero
    const Bundle<size> gravity = Whole::of(bundle_of(no_minus_zero), zero);
    const Bundle<size> frame = Whole::of(bundle_of(in.frame), zero);
    Bundle<4> fastest = zero;
    const auto go_on = [&](std::ptrdiff_t i, auto has_load) HWY_ATTR {
        double *motion = at.motion + 8 * i, *load = at.load + 8 * i;
        Bundle<size> now = bundle_at<size>(motion), gains = gravity;
        if (has_load.value) gains = multiply_add(bundle_at<size>(load), Whole::fourths(motion), gravity);
        now = kicked<ends, begins, drags>(now, gains, kicks, kNoMotion);
        if (begins) {
            double* place = at.place + 4 * i;
            const double radius = place[3];
            put(drifted<closes>(bundle_at<4>(place), first_four(now), closing, whole), place);
            if (has_load.value) put(nothing, load);
            const Bundle<size> relative = now - frame;
            fastest = larger_size(fastest, first_four(relative));
            if (at.rounded) put_rounded(Whole::with_radius(relative, radius), at.rounded + 8 * i);
        }
        put(now, motion);
    };
    std::ptrdiff_t i = begin;
    for (; i + kTogether <= end; i += kTogether) {
        const std::uint64_t loads = at.loads_from(i);
        at.fetch_ahead(i, loads);
        if (loads & kAllTogether)
            for (int k = 0; k < kTogether; ++k) go_on(i + k, std::true_type());
        else
            for (int k = 0; k < kTogether; ++k) go_on(i + k, std::false_type());
    }
    for (; i < end; ++i) go_on(i, std::true_type());
    HWY_ALIGN double f[4];
    put(fastest, f);
    return {f[0], f[1], f[2]};
}

template <bool ends, bool begins, bool closes = false>
HWY_INLINE Vec3 pass(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const auto of = [&](auto rubs, auto drags) HWY_ATTR {
        return pass_of<ends, begins, closes, rubs.value, drags.value>(grains, in, begin, end);
    };
    const std::true_type yes;
    const std::false_type no;
    if (in.keep == 1) return in.rubs ? of(yes, no) : of(no, no);
    return in.rubs ? of(yes, yes) : of(no, yes);
}

Vec3 first_half(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<false, true>(grains, in, begin, end);
}

Vec3 second_half(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<true, false>(grains, in, begin, end);
}

Vec3 both_halves(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return in.closing_drift == 0 ? pass<true, true>(grains, in, begin, end)
                                 : pass<true, true, true>(grains, in, begin, end);
}

void only_drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Numbers at(grains, in);
    const Bundle<4> whole = bundle_of(Vec3(in.drift, in.drift, in.drift));
    for (std::ptrdiff_t i = begin; i < end; ++i) {
        double* place = at.place + 4 * i;
        put(multiply_add(whole, bundle_at<4>(at.motion + 8 * i), bundle_at<4>(place)), place);
    }
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

namespace {

// Rotates q about the axis of `rate` by the angle |rate| * step. The result has unit length.
Quaternion turned(const Quaternion& q, const Vec3& rate, double step) {
    const double angle = rate.norm() * step;
    if (angle == 0) return q;
    return (rotation_about(rate.normalized(), angle) * q).normalized();
}

}  // namespace

void turn(Grains& grains, const KickInput& in, double time, std::int32_t begin, std::int32_t end) {
    if (!in.rubs || grains.orientation.empty()) return;
    for (std::int32_t i = begin; i < end; ++i) {
        grains.orientation[i] = turned(grains.orientation[i], grains.motion[i].spin, time);
    }
}

HWY_EXPORT(first_half);
HWY_EXPORT(second_half);
HWY_EXPORT(both_halves);
HWY_EXPORT(only_drift);

Vec3 kick_and_drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Vec3 fastest = HWY_DYNAMIC_DISPATCH(first_half)(grains, in, begin, end);
    turn(grains, in, in.drift, begin, end);
    return fastest;
}

void kick(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    HWY_DYNAMIC_DISPATCH(second_half)(grains, in, begin, end);
}

Vec3 kick_and_go_on(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Vec3 fastest = HWY_DYNAMIC_DISPATCH(both_halves)(grains, in, begin, end);
    if (in.closing_drift != 0) turn(grains, in, in.closing_drift, begin, end);
    turn(grains, in, in.drift, begin, end);
    return fastest;
}

void fly(Grains& grains, const FreeFlight& flight, std::int32_t begin, std::int32_t end) {
    KickInput kicks = flight.kicks;
    kicks.unloaded = true;
    kicks.loaded = nullptr;
    flight.begins ? HWY_DYNAMIC_DISPATCH(first_half)(grains, kicks, begin, end)
                  : HWY_DYNAMIC_DISPATCH(both_halves)(grains, kicks, begin, end);
}

void drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    HWY_DYNAMIC_DISPATCH(only_drift)(grains, in, begin, end);
    turn(grains, in, in.drift, begin, end);
}

void round_motion(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    if (grains.rounded.empty()) return;
    for (std::int32_t i = begin; i < end; ++i) {
        const Eigen::Vector3f velocity = (grains.motion[i].velocity - in.frame).cast<float>();
        const Eigen::Vector3f rate = grains.motion[i].spin.cast<float>();
        grains.rounded[i] = {{velocity.x(), velocity.y(), velocity.z()},
                             static_cast<float>(grains.motion[i].inverse_mass),
                             {rate.x(), rate.y(), rate.z()},
                             static_cast<float>(grains.place[i].radius)};
    }
}

}  // namespace grainreel
#endif
