// The formulas of contacts between a grain and a plate, a wall that ends at an edge or a gap, for one number
// or a register.
#if defined(GRAINREEL_STEP_PLATE_FORMULAS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_PLATE_FORMULAS_INL
#undef GRAINREEL_STEP_PLATE_FORMULAS_INL
#else
#define GRAINREEL_STEP_PLATE_FORMULAS_INL
#endif

#include "engine/step/geometry/wall_formulas-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// A grain at a wall that may end. v = A u + B s points from the nearest point of the wall to the centre of
// the grain; see distance_to_plate() (engine/state/container_faces.hpp). u is the distance from the endless
// wall, and A (`across`) its direction. s < 0 says how far the centre lies beyond the edge, and B (`back`)
// points back onto the wall.
//
// Where s < 0 the nearest point is on the edge, and v turns as the grain moves in the plane of A and B. At a
// round wall or gap, v also turns about the axis: if the grain moves by d along A x B, the tip of v moves by
// `round_share` times d.
template <class R>
struct AtPlate {
    Triple<R> v, around;  // `around` = A x B, unit, or zero where there is no edge
    R distance, round_share;
    MaskFor<R> at_edge;
};

// The numbers of a FaceRecord and of a FaceEnd (walls.hpp).
template <class R>
struct Plate {
    Triple<R> normal;
    R level;
    Triple<R> axis;
    R radius;
    Triple<R> along;
    R edge_level, out_x, out_y, gap, two_sided;
};

template <class R>
HWY_INLINE AtPlate<R> at_plate(const Triple<R>& centre, const Plate<R>& p) {
    const R zero(0.0), one(1.0);
    const Triple<R> from = centre - p.axis;
    const auto round = p.radius > zero, open = p.gap > zero, two_sided = p.two_sided > zero;

    const Triple<R> out{from.x * p.out_x, from.y * p.out_y, zero};
    const R rho = root(out.squared());
    const R one_over_rho = select(rho > zero, one / rho, zero);
    const Triple<R> outwards = out * one_over_rho;

    const R u = select(round, rho - p.radius, p.normal.dot(centre) - p.level);
    const R beyond = select(open, rho - p.gap, p.along.dot(centre) - p.edge_level);
    const R s = smaller(beyond, zero);
    const Triple<R> across = select(round, outwards, p.normal);
    const Triple<R> back = select(open, outwards, p.along);

    AtPlate<R> at;
    at.v = (across * u).plus(back, s);
    at.around = across.cross(back);
    at.distance = select(two_sided, root(multiply_add(u, u, s * s)), select(round, -u, u));
    const auto round_gap = p.out_x > zero;  // of planes; for round walls the next line has its own case
    at.round_share = select(round, u * one_over_rho, select(round_gap, s * one_over_rho, zero));
    at.at_edge = s < zero;
    return at;
}

// How the normal k swings. The part of the motion perpendicular to k that turns v is: along the edge by
// round_share, and the rest where the nearest point is on the edge.
template <class R>
HWY_INLINE Swing<R> swing_at_plate(const AtPlate<R>& at, const Triple<R>& k, const Triple<R>& velocity,
                                   R inverse, const HalfTimes<R>& half) {
    const R closing = k.dot(velocity), along_edge = at.around.dot(velocity), one(1.0);
    const Triple<R> upright = velocity.less(k, closing).less(at.around, along_edge);
    return {(upright * select(at.at_edge, one, R(0.0))).plus(at.around, along_edge * at.round_share), inverse,
            select(at.at_edge, less_product(one, R(2.0) * (half.step * inverse), closing), one)};
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
