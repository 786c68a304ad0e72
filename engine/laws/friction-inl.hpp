// Parts shared by the laws of friction: Coulomb's cap on the tangential force, the turning of the last step's
// force with its contact, and contacts without friction.
#if defined(GRAINREEL_LAWS_FRICTION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_FRICTION_INL
#undef GRAINREEL_LAWS_FRICTION_INL
#else
#define GRAINREEL_LAWS_FRICTION_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"
#include "engine/vector/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Replaces infinite friction by a number whose products stay finite, so that a contact without normal force
// holds nothing.
HWY_INLINE double finite_friction(double friction) {
    return std::isinf(friction) ? 1e150 : friction;
}

// Shortens `force` to `limit` (>= 0) where it is longer.
template <class R>
HWY_INLINE Triple<R> capped_at(const Triple<R>& force, R limit) {
    const R squared = force.squared();
    return force * select(squared > limit * limit, limit / root(squared), R(1));
}

// The square (N^2) of the part of `force` that a cap lets act. A spring beyond the cap gives back no more
// energy than a spring at the cap.
template <class R>
HWY_INLINE R squared_within(const Triple<R>& force, R limit) {
    return smaller(force.squared(), limit * limit);
}

// Turns a tangential force with its contact, by Cayley's rotation about the axis of `turn` by 2 atan |turn|.
// This keeps the length exactly. The original program projects the force onto the new contact plane instead,
// which misses the twist. Rounding leaves a small part along `normal` (the present normal), which is taken
// off.
template <class R>
HWY_INLINE Triple<R> carry_along(const Triple<R>& force, const Triple<R>& turn, const Triple<R>& normal) {
    const Triple<R> once = turn.cross(force), twice = turn.cross(once);
    return force.plus(once + twice, R(2) / (R(1) + turn.squared())).across(normal);
}

// The law without a tangential force. It has no history and no torque, and reads no spin.

struct Frictionless {
    static constexpr bool rubs = false, gains_by_onset = false;

    template <class R>
    struct Parameters {
        template <class Each>
        HWY_INLINE void each(const Each&) {}
    };
    static Parameters<double> from(const PairPlan&) { return {}; }

    template <class R>
    struct History {
        template <class Each>
        HWY_INLINE void each(const Each&) {}
    };
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
