// The geometry of contacts between grains and plates, which are walls that end at an edge or a gap, for as
// many contacts at once as a register holds.
#include "engine/step/geometry/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/geometry/plate_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/geometry/turn-inl.hpp"

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
struct AtPlate {
    Triple<Lanes> v, around;  // `around` = A x B, unit, or zero where there is no edge
    Lanes distance, radius, round_share;
    LanesMask at_edge;
};
HWY_INLINE AtPlate at_plate(const double* place, const WallState& walls, const std::int32_t* i,
                            const std::int32_t* face) {
    const Lanes zero(0.0), one(1.0);
    const auto grain = load_bundles(place, kPlaceNumbers, i);
    const auto plane = load_bundles(numbers(walls.faces), 8, face);
    const auto axis = load_bundles(numbers(walls.faces) + 4, 8, face);
    const auto edge = load_bundles(numbers(walls.ends), 8, face);
    const auto end = load_bundles(numbers(walls.ends) + 4, 8, face);
    const Triple<Lanes> centre = triple(grain), from = centre - triple(axis);
    const Lanes radius(axis.d), gap(end.c);
    const LanesMask round = radius > zero, open = gap > zero, two_sided = Lanes(end.d) > zero;

    const Triple<Lanes> out{from.x * Lanes(end.a), from.y * Lanes(end.b), zero};
    const Lanes rho = root(out.squared());
    const Lanes one_over_rho = select(rho > zero, one / rho, zero);
    const Triple<Lanes> outwards = out * one_over_rho;

    const Lanes u = select(round, rho - radius, triple(plane).dot(centre) - Lanes(plane.d));
    const Lanes beyond = select(open, rho - gap, triple(edge).dot(centre) - Lanes(edge.d));
    const Lanes s = smaller(beyond, zero);
    const Triple<Lanes> across = select(round, outwards, triple(plane));
    const Triple<Lanes> back = select(open, outwards, triple(edge));

    AtPlate at;
    at.v = (across * u).plus(back, s);
    at.around = across.cross(back);
    at.distance = select(two_sided, root(multiply_add(u, u, s * s)), select(round, -u, u));
    at.radius = Lanes(grain.d);
    const LanesMask round_gap =
        Lanes(end.a) > zero;  // of planes; for round walls the next line has its own case
    at.round_share = select(round, u * one_over_rho, select(round_gap, s * one_over_rho, zero));
    at.at_edge = s < zero;
    return at;
}

std::uint64_t plates_that_touch(const Grains& grains, const std::int32_t* i, const std::int32_t* face,
                                int count, const WallState& walls) {
    std::uint64_t touching = 0;
    for (int c = 0; c < count; c += kLanes) {
        const AtPlate at = at_plate(numbers(grains.place), walls, i + c, face + c);
        touching |= bits(at.distance < at.radius) << c;
    }
    return touching;
}

template <class Number>
void plates_chunk(const GeometryInput& in, const WallState& walls, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    const double* motion = numbers(in.grains->motion);
    out.touching = 0;
    const Lanes zero(0.0), one(1.0), turn(0.5 * in.turns_for), half_step(0.5 * in.step);
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const std::int32_t *i = in.first + c, *face = in.second + c;
        const AtPlate at = at_plate(place, walls, i, face);
        const Lanes overlap = at.radius - at.distance;
        put<Number>(overlap, out.overlap, c);
        const LanesMask touching = overlap > zero;
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;

        const Lanes inverse = select(at.distance == zero, zero, one / at.distance);
        const Triple<Lanes> k = -(at.v * inverse);
        put<Number>(k, out.normal, c);
        if (in.radius) put<Number>(at.radius, out.effective_radius, c);
        if (in.wants == Wants::overlap && !in.mass) continue;

        const auto motion_one = load_bundles(motion, kMotionNumbers, i);
        if (in.mass) put<Number>(Lanes(motion_one.d), out.inverse_mass, c);
        if (in.wants == Wants::overlap) continue;

        Triple<Lanes> velocity = triple(motion_one) - triple(load_bundles(numbers(walls.motion), 8, face));
        if (in.wants >= Wants::spin) {
            const Lanes arm = in.arms == LeverArms::contact_plane ? at.distance : at.radius;
            const Triple<Lanes> rate = triple(load_bundles(motion + kSpinOfMotion, kMotionNumbers, i));
            const Lanes closing = k.dot(velocity), in_half = half_step * inverse;
            const Lanes along_edge = at.around.dot(velocity);
            const Triple<Lanes> upright = velocity.less(k, closing).less(at.around, along_edge);
            // The part of the motion perpendicular to k that turns v: along the edge by round_share, and the
            // rest where the nearest point is on the edge.
            const Triple<Lanes> across =
                (upright * select(at.at_edge, one, zero)).plus(at.around, along_edge * at.round_share);
            const Lanes farther = select(at.at_edge, less_product(one, Lanes(2.0) * in_half, closing), one);
            put<Number>(turn_of(k, across * (in_half * farther), Lanes(0.5) * half_step * rate.dot(k)),
                        out.turn, c);
            velocity = of_surfaces(velocity, rate * arm, k, across * (turn * inverse));
            put<Number>(arm, out.first_arm, c);
            if (in.wants == Wants::rolling) put<Number>(rate.across(k), in.rolling->rate, c);
        }
        put<Number>(velocity, out.velocity, c);
    }
}

void plates(const GeometryInput& in, const WallState& state, TouchChunk& out) {
    in.rounded ? plates_chunk<float>(in, state, out) : plates_chunk<double>(in, state, out);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(plates_that_touch);
HWY_EXPORT(plates);

std::uint64_t touching_plates(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                              int count, const WallState& walls) {
    return HWY_DYNAMIC_DISPATCH(plates_that_touch)(grains, first, second, count, walls);
}

void touch_plates(const GeometryInput& in, const WallState& state, TouchChunk& out) {
    HWY_DYNAMIC_DISPATCH(plates)(in, state, out);
}

}  // namespace grainreel
#endif
