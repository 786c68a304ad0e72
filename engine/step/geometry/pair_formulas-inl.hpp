// The formulas of contacts between two spheres, for one number or a register.
#if defined(GRAINREEL_STEP_PAIR_FORMULAS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_PAIR_FORMULAS_INL
#undef GRAINREEL_STEP_PAIR_FORMULAS_INL
#else
#define GRAINREEL_STEP_PAIR_FORMULAS_INL
#endif

#include "engine/step/geometry/turn-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// The vector (m) from one centre to the other. `period` is the period of x in m, or 0.
template <class R>
HWY_INLINE Triple<R> between(const Triple<R>& one, const Triple<R>& two, double period) {
    Triple<R> apart = two - one;
    if (period > 0) apart.x = nearest(apart.x, R(period));
    return apart;
}

// Whether the surfaces of a pair are closer than `gap` (m). `radii` is the sum of the radii.
template <class R>
HWY_INLINE auto are_closer(const Triple<R>& apart, R radii, R gap) {
    const R reach = radii + gap;
    return apart.squared() < reach * reach;
}

template <class R>
HWY_INLINE R effective_radius_of(R one, R two) {
    return one * two / (one + two);
}

// Arms that end at the plane of the circle in which the two spheres intersect. The two arms add up to the
// distance of the centres, and this conserves angular momentum. (The original program used the radii; see
// docs/notes/step.md.)
template <class R>
HWY_INLINE void to_contact_plane(R distance, R inverse, R& one, R& two) {
    one = R(0.5) * multiply_add((one - two) * (one + two), inverse, distance);
    two = distance - one;
}

// How the normal k between two spheres swings, by the velocity (m/s) of their centres.
template <class R>
HWY_INLINE Swing<R> swing_of_spheres(const Triple<R>& k, const Triple<R>& velocity, R inverse,
                                     const HalfTimes<R>& half) {
    const R closing = k.dot(velocity);
    return {velocity.less(k, closing), inverse,
            less_product(R(1.0), R(2.0) * (half.step * inverse), closing)};
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
