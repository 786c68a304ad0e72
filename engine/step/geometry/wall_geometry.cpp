// The geometry of contacts between a grain and a wall.
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/geometry/wall_point.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/geometry/wall_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/geometry/turn-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// A grain at a wall. The wall is a plane or a cylinder.
struct AtWall {
    Triple<Lanes> out_from_axis;
    Lanes from_axis, distance, radius;
    LanesMask round;
};
HWY_INLINE AtWall at_wall(const double* place, const WallState& walls, const std::int32_t* i,
                          const std::int32_t* face, Triple<Lanes>& into) {
    const Lanes zero(0.0);
    const auto grain = load_bundles(place, kPlaceNumbers, i);
    const auto plane = load_bundles(numbers(walls.faces), 8, face);
    const Triple<Lanes> centre = triple(grain);
    into = triple(plane);
    AtWall w{{zero, zero, zero}, zero, into.dot(centre) - Lanes(plane.d), Lanes(grain.d), zero > zero};
    if (!walls.any_round) return w;
    const auto cylinder = load_bundles(numbers(walls.faces) + 4, 8, face);
    w.out_from_axis = centre - triple(cylinder);
    w.out_from_axis.z = zero;
    w.from_axis = root(w.out_from_axis.squared());
    w.round = Lanes(cylinder.d) > zero;
    w.distance = select(w.round, Lanes(cylinder.d) - w.from_axis, w.distance);
    return w;
}

std::uint64_t walls_that_touch(const Grains& grains, const std::int32_t* i, const std::int32_t* face,
                               int count, const WallState& walls) {
    std::uint64_t touching = 0;
    Triple<Lanes> into;
    for (int c = 0; c < count; c += kLanes) {
        const AtWall w = at_wall(numbers(grains.place), walls, i + c, face + c, into);
        touching |= bits(w.distance < w.radius) << c;
    }
    return touching;
}

template <Wants wants, class Number>
void walls_chunk(const GeometryInput& in, const WallState& walls, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    const double* motion = numbers(in.grains->motion);
    out.touching = 0;
    const Lanes turn(0.5 * in.turns_for), half_step(0.5 * in.step);
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const std::int32_t *i = in.first + c, *face = in.second + c;
        Triple<Lanes> into;
        const auto [out_from_axis, from_axis, distance, radius, round] = at_wall(place, walls, i, face, into);
        const Lanes overlap = radius - distance;
        put<Number>(overlap, out.overlap, c);
        const LanesMask touching = overlap > Lanes(0.0);
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;

        Lanes inverse(0.0);
        if (walls.any_round) inverse = select(from_axis > inverse, Lanes(1.0) / from_axis, inverse);
        const Triple<Lanes> k = select(round, out_from_axis * inverse, -into);
        put<Number>(k, out.normal, c);
        if (in.radius) put<Number>(radius, out.effective_radius, c);
        if (wants == Wants::overlap && !in.mass) continue;

        const auto motion_one = load_bundles(motion, kMotionNumbers, i);
        if (in.mass) put<Number>(Lanes(motion_one.d), out.inverse_mass, c);
        if constexpr (wants == Wants::overlap) continue;

        Triple<Lanes> velocity = triple(motion_one) - triple(load_bundles(numbers(walls.motion), 8, face));
        if constexpr (wants >= Wants::spin) {
            const Lanes arm = in.arms == LeverArms::contact_plane ? distance : radius;
            const Triple<Lanes> rate = triple(load_bundles(motion + kSpinOfMotion, kMotionNumbers, i));
            // A cylinder's normal turns as the grain moves around the axis. A plane's normal does not turn.
            const Lanes closing = k.dot(velocity), in_half = half_step * inverse;
            Triple<Lanes> across = velocity.less(k, closing) * select(round, Lanes(-1.0), Lanes(0.0));
            across.z = Lanes(0.0);
            const Lanes nearer = multiply_add(Lanes(2.0) * in_half, closing, Lanes(1.0));
            put<Number>(turn_of(k, across * (in_half * nearer), Lanes(0.5) * half_step * rate.dot(k)),
                        out.turn, c);
            velocity = of_surfaces(velocity, rate * arm, k, across * (turn * inverse));
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
