// From the forces of a contact to those on its bodies, for one number or a register.
#if defined(GRAINREEL_STEP_PUSHES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_PUSHES_INL
#undef GRAINREEL_STEP_PUSHES_INL
#else
#define GRAINREEL_STEP_PUSHES_INL
#endif

#include "engine/vector/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// The second body gains `force`, and the first body loses it. The first body loses the torque `first_loses`,
// and the second gains the torque `second_gains`.
template <class R>
struct Pushes {
    Triple<R> force, first_loses, second_gains;
};

// With turning = k x T, the torque on either body is -arm * turning. `across` is the tangential force T.
template <class R>
HWY_INLINE Pushes<R> pushes_of(const Triple<R>& k, R normal, const Triple<R>& across, R first_arm,
                               R second_arm) {
    const Triple<R> turning = k.cross(across);
    return {across.plus(k, normal), turning * first_arm, -(turning * second_arm)};
}

// Adds the resistance to rolling.
template <class R>
HWY_INLINE void add_rolling(const Triple<R>& torque, Pushes<R>& p) {
    p.first_loses += torque;
    p.second_gains += torque;
}

// The work (J) that a wall does on its grain in `step` (s). `force` is that on the wall.
template <class R>
HWY_INLINE R work_of(const Triple<R>& force, const Triple<R>& velocity, double step) {
    return force.dot(velocity) * R(-step);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
