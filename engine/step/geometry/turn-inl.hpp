// Formulas that contacts of pairs and of walls have in common: how surfaces move, and how contacts turn. Like
// all formulas of contacts, they take one number or a register.
#if defined(GRAINREEL_STEP_TURN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_TURN_INL
#undef GRAINREEL_STEP_TURN_INL
#else
#define GRAINREEL_STEP_TURN_INL
#endif

#include "engine/vector/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Velocity of i's surface relative to j's, from the velocity of the centres and the spins times arms.
// Velocity and spins belong to the middle of the step, but the normal k belongs to its end. The normal of the
// middle is k + change. So the velocity is computed with k + change, and its normal part is then turned to
// lie along k. Without this, a pair that turns as one body would slip by its angle of turn in every step
// (Vyas et al., Comput. Phys. Commun. 310, 109524: time levels).
template <class L>
HWY_INLINE Triple<L> of_surfaces(const Triple<L>& velocity, const Triple<L>& spins, const Triple<L>& k,
                                 const Triple<L>& change) {
    return velocity.less(change, k.dot(velocity)) + spins.cross(k + change);
}

// Cayley's vector of a contact's turn during a step. The turn has two parts. The first part takes the old
// normal to k; the old normal is k + 2 `back`, scaled to unit length. Its vector a is taken as tan(angle) / 2
// along the axis, which makes the angle wrong by its cube / 4. The second part is a turn about k, by the
// angle 2 `twist`; its vector is b. Both parts together are a + b + b x a. (The old normal is not stored. It
// is found from the velocities, because the displacement between two forces is the velocity times the step.)
template <class L>
HWY_INLINE Triple<L> turn_of(const Triple<L>& k, const Triple<L>& back, L twist) {
    return back.cross(k).plus(k + back, twist);
}

// The times (s) by which a contact's motion is found: half of GeometryInput::turns_for, and half a step.
template <class R>
struct HalfTimes {
    R turn, step;
};

// How the normal swings: `across` (m/s) is the part of the velocity that turns it, at the distance 1 /
// `inverse` (m), and `farther` is the distance now over that at the step's beginning.
template <class R>
struct Swing {
    Triple<R> across;
    R inverse, farther;
};

// Velocity of i's surface relative to j's; of_surfaces(). `spins` are spins times arms.
template <class R>
HWY_INLINE Triple<R> surface_velocity(const Triple<R>& velocity, const Triple<R>& spins, const Triple<R>& k,
                                      const Swing<R>& swing, const HalfTimes<R>& half) {
    return of_surfaces(velocity, spins, k, swing.across * (half.turn * swing.inverse));
}

// Cayley's vector of a contact's turn; turn_of(). `both` is the sum of the spins.
template <class R>
HWY_INLINE Triple<R> turn_by(const Swing<R>& swing, const Triple<R>& both, const Triple<R>& k,
                             const HalfTimes<R>& half) {
    return turn_of(k, swing.across * (half.step * swing.inverse * swing.farther),
                   R(0.5) * half.step * both.dot(k));
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
