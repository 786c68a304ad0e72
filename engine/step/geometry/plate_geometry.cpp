// The geometry of contacts between grains and plates, which are walls that end at an edge or a gap, for as
// many contacts at once as a register holds.
#include "engine/step/geometry/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/geometry/plate_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/geometry/plate_formulas-inl.hpp"
#include "engine/step/geometry/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct GrainAtPlate {
    AtPlate<Lanes> at;
    Lanes radius;
};
HWY_INLINE GrainAtPlate grain_at_plate(const double* place, const WallState& walls, const std::int32_t* i,
                                       const std::int32_t* face) {
    const auto grain = load_bundles(place, kPlaceNumbers, i);
    const auto plane = load_bundles(numbers(walls.faces), 8, face);
    const auto axis = load_bundles(numbers(walls.faces) + 4, 8, face);
    const auto edge = load_bundles(numbers(walls.ends), 8, face);
    const auto end = load_bundles(numbers(walls.ends) + 4, 8, face);
    const Plate<Lanes> plate{triple(plane), Lanes(plane.d), triple(axis), Lanes(axis.d), triple(edge),
                             Lanes(edge.d), Lanes(end.a),   Lanes(end.b), Lanes(end.c),  Lanes(end.d)};
    return {at_plate(triple(grain), plate), Lanes(grain.d)};
}

std::uint64_t plates_that_touch(const Grains& grains, const std::int32_t* i, const std::int32_t* face,
                                int count, const WallState& walls) {
    std::uint64_t touching = 0;
    for (int c = 0; c < count; c += kLanes) {
        const auto [at, radius] = grain_at_plate(numbers(grains.place), walls, i + c, face + c);
        touching |= bits(at.distance < radius) << c;
    }
    return touching;
}

template <class Number>
void plates_chunk(const GeometryInput& in, const WallState& walls, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    const double* motion = numbers(in.grains->motion);
    out.touching = 0;
    const Lanes zero(0.0), one(1.0);
    const HalfTimes<Lanes> half{Lanes(0.5 * in.turns_for), Lanes(0.5 * in.step)};
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const std::int32_t *i = in.first + c, *face = in.second + c;
        const auto [at, radius] = grain_at_plate(place, walls, i, face);
        const Lanes overlap = radius - at.distance;
        put<Number>(overlap, out.overlap, c);
        const LanesMask touching = overlap > zero;
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;

        const Lanes inverse = select(at.distance == zero, zero, one / at.distance);
        const Triple<Lanes> k = -(at.v * inverse);
        put<Number>(k, out.normal, c);
        if (in.radius) put<Number>(radius, out.effective_radius, c);
        if (in.wants == Wants::overlap && !in.mass) continue;

        const auto motion_one = load_bundles(motion, kMotionNumbers, i);
        if (in.mass) put<Number>(Lanes(motion_one.d), out.inverse_mass, c);
        if (in.wants == Wants::overlap) continue;

        Triple<Lanes> velocity = triple(motion_one) - triple(load_bundles(numbers(walls.motion), 8, face));
        if (in.wants >= Wants::spin) {
            const Lanes arm = in.arms == LeverArms::contact_plane ? at.distance : radius;
            const Triple<Lanes> rate = triple(load_bundles(motion + kSpinOfMotion, kMotionNumbers, i));
            const Swing<Lanes> swing = swing_at_plate(at, k, velocity, inverse, half);
            put<Number>(turn_by(swing, rate, k, half), out.turn, c);
            velocity = surface_velocity(velocity, rate * arm, k, swing, half);
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
