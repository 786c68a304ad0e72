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

// Turns `force` as its contact has turned: Cayley's rotation, about the axis of `turn` by 2 atan |turn|,
// exact in length. Projection alone, as in the original program, cannot see the twist. What rounding leaves
// of it along `normal`, the contact's own of now, goes.
template <class R>
HWY_INLINE Triple<R> carry_along(const Triple<R>& force, const Triple<R>& turn, const Triple<R>& normal) {
    const Triple<R> once = turn.cross(force), twice = turn.cross(once);
    return force.plus(once + twice, R(2) / (R(1) + turn.squared())).across(normal);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
