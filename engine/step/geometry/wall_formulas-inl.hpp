// The formulas of contacts between a grain and a plane or a cylinder, for one number or a register.
#if defined(GRAINREEL_STEP_WALL_FORMULAS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_WALL_FORMULAS_INL
#undef GRAINREEL_STEP_WALL_FORMULAS_INL
#else
#define GRAINREEL_STEP_WALL_FORMULAS_INL
#endif

#include <utility>

#include "engine/step/geometry/turn-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class R>
using MaskFor = decltype(std::declval<R>() > std::declval<R>());

// A grain at a wall. The wall is a plane or a cylinder.
template <class R>
struct AtWall {
    Triple<R> out_from_axis;  // m, of a cylinder
    R from_axis, distance;    // m, from the axis; from the wall
    MaskFor<R> round;
};

// At a plane. `into` is its normal, and `level` (m) that of a point of it.
template <class R>
HWY_INLINE AtWall<R> at_plane(const Triple<R>& centre, const Triple<R>& into, R level) {
    const R zero(0.0);
    return {{zero, zero, zero}, zero, into.dot(centre) - level, zero > zero};
}

// At a wall that is a cylinder about `axis` if its radius is > 0, else the plane of `w`.
template <class R>
HWY_INLINE void or_cylinder(const Triple<R>& centre, const Triple<R>& axis, R radius, AtWall<R>& w) {
    const R zero(0.0);
    w.out_from_axis = centre - axis;
    w.out_from_axis.z = zero;
    w.from_axis = root(w.out_from_axis.squared());
    w.round = radius > zero;
    w.distance = select(w.round, radius - w.from_axis, w.distance);
}

// 1 / distance from the axis; 0 on it.
template <class R>
HWY_INLINE R inverse_of(R from_axis) {
    const R zero(0.0);
    return select(from_axis > zero, R(1.0) / from_axis, zero);
}

template <class R>
HWY_INLINE Triple<R> normal_to(const AtWall<R>& w, R inverse, const Triple<R>& into) {
    return select(w.round, w.out_from_axis * inverse, -into);
}

// How the normal k swings. A cylinder's normal turns as the grain moves around the axis. A plane's normal
// does not turn.
template <class R>
HWY_INLINE Swing<R> swing_at_wall(const Triple<R>& k, const Triple<R>& velocity, MaskFor<R> round, R inverse,
                                  const HalfTimes<R>& half) {
    const R closing = k.dot(velocity);
    Triple<R> across = velocity.less(k, closing) * select(round, R(-1.0), R(0.0));
    across.z = R(0.0);
    return {across, inverse, multiply_add(R(2.0) * (half.step * inverse), closing, R(1.0))};
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
