// The geometry of contacts between a grain and a wall.
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/geometry/wall_point.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/geometry/wall_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/geometry/rows-inl.hpp"
#include "engine/step/geometry/wall_formulas-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE AtWall<Lanes> at_wall(const double* place, const WallState& walls, const std::int32_t* i,
                                 const std::int32_t* face, Triple<Lanes>& into, Lanes& radius) {
    const auto grain = load_bundles(place, kPlaceNumbers, i);
    const auto plane = load_bundles(numbers(walls.faces), 8, face);
    const Triple<Lanes> centre = triple(grain);
    into = triple(plane);
    radius = grain.d;
    AtWall<Lanes> w = at_plane(centre, into, Lanes(plane.d));
    if (!walls.any_round) return w;
    const auto cylinder = load_bundles(numbers(walls.faces) + 4, 8, face);
    or_cylinder(centre, triple(cylinder), Lanes(cylinder.d), w);
    return w;
}

std::uint64_t walls_that_touch(const Grains& grains, const std::int32_t* i, const std::int32_t* face,
                               int count, const WallState& walls) {
    std::uint64_t touching = 0;
    Triple<Lanes> into;
    Lanes radius;
    for (int c = 0; c < count; c += kLanes) {
        const AtWall<Lanes> at = at_wall(numbers(grains.place), walls, i + c, face + c, into, radius);
        touching |= bits(at.distance < radius) << c;
    }
    return touching;
}

template <Wants wants, class Number>
void walls_chunk(const GeometryInput& in, const WallState& walls, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    const double* motion = numbers(in.grains->motion);
    out.touching = 0;
    const HalfTimes<Lanes> half{Lanes(0.5 * in.turns_for), Lanes(0.5 * in.step)};
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const std::int32_t *i = in.first + c, *face = in.second + c;
        Triple<Lanes> into;
        Lanes radius;
        const AtWall<Lanes> at = at_wall(place, walls, i, face, into, radius);
        const Lanes overlap = radius - at.distance;
        put<Number>(overlap, out.overlap, c);
        const LanesMask touching = overlap > Lanes(0.0);
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;

        Lanes inverse(0.0);
        if (walls.any_round) inverse = inverse_of(at.from_axis);
        const Triple<Lanes> k = normal_to(at, inverse, into);
        put<Number>(k, out.normal, c);
        if (in.radius) put<Number>(radius, out.effective_radius, c);
        if (wants == Wants::overlap && !in.mass) continue;

        const auto motion_one = load_bundles(motion, kMotionNumbers, i);
        if (in.mass) put<Number>(Lanes(motion_one.d), out.inverse_mass, c);
        if constexpr (wants == Wants::overlap) continue;

        Triple<Lanes> velocity = triple(motion_one) - triple(load_bundles(numbers(walls.motion), 8, face));
        if constexpr (wants >= Wants::spin) {
            const Lanes arm = in.arms == LeverArms::contact_plane ? at.distance : radius;
            const Triple<Lanes> rate = triple(load_bundles(motion + kSpinOfMotion, kMotionNumbers, i));
            const Swing<Lanes> swing = swing_at_wall(k, velocity, at.round, inverse, half);
            put<Number>(turn_by(swing, rate, k, half), out.turn, c);
            velocity = surface_velocity(velocity, rate * arm, k, swing, half);
            put<Number>(arm, out.first_arm, c);
            if constexpr (wants == Wants::rolling) put<Number>(rate.across(k), in.rolling->rate, c);
        }
        put<Number>(velocity, out.velocity, c);
    }
}

template <class Number>
void walls_in(const GeometryInput& in, const WallState& state, TouchChunk& out) {
    switch (in.wants) {
        case Wants::overlap:
            return walls_chunk<Wants::overlap, Number>(in, state, out);
        case Wants::velocity:
            return walls_chunk<Wants::velocity, Number>(in, state, out);
        case Wants::spin:
            return walls_chunk<Wants::spin, Number>(in, state, out);
        case Wants::rolling:
            return walls_chunk<Wants::rolling, Number>(in, state, out);
    }
}

void walls(const GeometryInput& in, const WallState& state, TouchChunk& out) {
    in.rounded ? walls_in<float>(in, state, out) : walls_in<double>(in, state, out);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(walls_that_touch);
HWY_EXPORT(walls);

std::uint64_t touching_walls(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const WallState& walls) {
    if (!walls.ends.empty()) return touching_plates(grains, first, second, count, walls);
    return HWY_DYNAMIC_DISPATCH(walls_that_touch)(grains, first, second, count, walls);
}

void touch_walls(const GeometryInput& in, const WallState& state, TouchChunk& out) {
    if (state.turning) return touch_turning_walls(in, state, out);
    if (!state.ends.empty()) return touch_plates(in, state, out);
    HWY_DYNAMIC_DISPATCH(walls)(in, state, out);
}

}  // namespace grainreel
#endif
