// Carrying a tangential force along with a contact that turns.
#if defined(GRAINREEL_LAWS_CARRY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_CARRY_INL
#undef GRAINREEL_LAWS_CARRY_INL
#else
#define GRAINREEL_LAWS_CARRY_INL
#endif

#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Turns `force` (perpendicular to `before`) by the smallest rotation that takes unit normal `before` to
// `now`, then by `twist` (rad) about `now`; its length is kept. Projection alone, as in the original program,
// cannot see the twist. With c = before x now and d = before . now, Rodrigues' formula for f perpendicular to
// `before` is f d + c x f + c (c . f) / (1 + d). c is taken from now - before, and 1 - d as half its square:
// nothing at all where the contact does not turn, for what rounding leaves of the products would act every
// step. The twist is Cayley's rotation by 2 atan(twist / 2): exact in length, and in angle to twist^3 / 12. A
// new contact has no force and `before` zero: it stays without.
template <class R>
HWY_INLINE Triple<R> carry_along(const Triple<R>& force, const Triple<R>& before, const Triple<R>& now,
                                 R twist) {
    const Triple<R> turn = now - before, axis = before.cross(turn);
    const R lost = R(0.5) * turn.squared();  // 1 - d
    const R t = R(0.5) * twist, t_squared = t * t;
    const R from_turn = R(2) - lost, from_twist = R(1) + t_squared;
    const R both = R(1) / (from_turn * from_twist);  // one division for the two
    const Triple<R> tilted = force.less(force, lost) + axis.cross(force);
    // Nothing of it is along the normal but round-off.
    const Triple<R> turned = tilted.plus(axis, axis.dot(force) * (both * from_twist)).across(now);
    const R scale = both * from_turn;
    return (turned * ((R(1) - t_squared) * scale)).plus(now.cross(turned), R(2) * t * scale);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
