// Coulomb's cap.
#if defined(GRAINREEL_LAWS_FRICTION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_FRICTION_INL
#undef GRAINREEL_LAWS_FRICTION_INL
#else
#define GRAINREEL_LAWS_FRICTION_INL
#endif

#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Infinite friction as a number whose products stay finite: a contact without normal force holds nothing.
HWY_INLINE double finite_friction(double friction) {
    return std::isinf(friction) ? 1e150 : friction;
}

// `force` shortened to `limit` >= 0 where it is longer.
template <class R>
HWY_INLINE Triple<R> capped_at(const Triple<R>& force, R limit) {
    const R squared = force.squared();
    const auto slides = squared > limit * limit;
    const Triple<R> shortened = force * (limit / root(squared));
    return select(slides, shortened, force);
}

// N^2, of the part of `force` that a cap lets act: a spring beyond it gives back no more than one at it.
template <class R>
HWY_INLINE R squared_within(const Triple<R>& force, R limit) {
    return smaller(force.squared(), limit * limit);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
