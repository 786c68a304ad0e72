#include "engine/step/forces/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/forces/contact_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/row-inl.hpp"
#include "engine/step/grid/places-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Of i's surface against j's, the centres' velocity and the spins' share of it being those of the middle of
// the step, k that of its end. In the middle it was k + change: the velocity is taken with that and given
// with k in its place, or a pair that turns as one body would slip by its angle a step (Vyas et al., Comput.
// Phys. Commun. 310, 109524: time levels).
template <class L>
HWY_INLINE Triple<L> of_surfaces(const Triple<L>& velocity, const Triple<L>& spins, const Triple<L>& k,
                                 const Triple<L>& change) {
    return velocity.less(change, k.dot(velocity)) + spins.cross(k + change);
}

// Cayley's vector of a contact's turn: what took k + 2 `back`, scaled to unit length, to k, then a turn about
// k of which `twist` is the half. That is tan(angle) / 2 along the axis of the first, off by the angle's cube
// / 4; of the two together a + b + b x a. (The displacements between two forces are the velocities times the
// step, so that k need not be kept.)
template <class L>
HWY_INLINE Triple<L> turn_of(const Triple<L>& k, const Triple<L>& back, L twist) {
    return back.cross(k).plus(k + back, twist);
}

// Where the places of a chunk's bodies start, in doubles, worked out once: their motion starts twice as far.
struct Places {
    alignas(64) std::int32_t first[kChunk], second[kChunk];

    HWY_INLINE Places(const std::int32_t* i, const std::int32_t* j, int count) {
        constexpr std::int32_t stride = sizeof(Place) / sizeof(double);
        for (int c = 0; c < count; ++c) {
            first[c] = stride * i[c];
            second[c] = stride * j[c];
        }
        // Up to a whole register.
        for (int c = count; c % kBlock != 0; ++c) first[c] = first[c - 1], second[c] = second[c - 1];
    }
};
static_assert(sizeof(Motion) == 2 * sizeof(Place) && sizeof(RoundedMotion) == sizeof(Place));

std::uint64_t pairs_within(const Grains& grains, const std::int32_t* i, const std::int32_t* j, int count,
                           double period, double gap) {
    const double* place = numbers(grains.place);
    const Places at(i, j, count);
    std::uint64_t touching = 0;
    for (int c = 0; c < count; c += kLanes) {
        const auto between = load_relative(place, 1, at.second + c, at.first + c);
        Triple<Lanes> apart = triple(between);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes reach = Lanes(between.d) + Lanes(gap);
        touching |= bits(apart.squared() < reach * reach) << c;
    }
    return touching;
}

// As many contacts as laws may read: of what fills the last block, too, is known whether it touches.
HWY_INLINE int whole_blocks(int count) {
    return (count + kBlock - 1) / kBlock * kBlock;
}

// A chunk goes through in sweeps, as many as its law wants: places, distances, velocities, spins. (One sweep
// for all was no faster.)
//
// Distances, for now where inverse distances will be, likewise what lies between the centres, and radii where
// arms will be; overlaps.
void sweep_places(const GeometryInput& in, const Places& at, double period, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    out.touching = 0;
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        out.fetch_some();
        const auto one = load_records(place, 1, at.first + c), two = load_records(place, 1, at.second + c);
        Triple<Lanes> apart = triple(two) - triple(one);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes radius_one(one.d), radius_two(two.d), distance = root(apart.squared());
        const Lanes overlap = radius_one + radius_two - distance;
        out.touching |= bits(overlap > Lanes(0.0)) << c;
        put<double>(overlap, out.overlap, c);
        put<double>(apart, out.normal, c);
        put<double>(distance, out.inverse_distance, c);
        if (in.wants < Wants::spin && !in.radius) continue;
        put<double>(radius_one, out.first_arm, c);
        put<double>(radius_two, out.second_arm, c);
    }
}

// The same for rows of floats, but for what sweep_distances() does, and for the radii. Of R, their sum, and
// the distance d the small difference R^2 - d^2 = (R - d)(R + d) is taken as doubles and rounded then, so
// that all digits of the overlap count; d may be rounded before.
void sweep_rounded_places(const GeometryInput& in, const Places& at, double period, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    out.touching = 0;
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        out.fetch_some();
        const auto between = load_relative(place, 1, at.second + c, at.first + c);
        Triple<Lanes> apart = triple(between);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes reach(between.d), difference = reach * reach - apart.squared();
        out.touching |= bits(difference > Lanes(0.0)) << c;
        put<float>(difference, out.overlap, c);
        put<float>(apart, out.normal, c);
        put<float>(reach, out.inverse_distance, c);
    }
}

// Normals, inverse distances and, for sweep_spins(), distances where the turn will be.
template <class L>
void sweep_distances(const GeometryInput& in, TouchChunk& out) {
    using Number = NumberOf<L>;
    for (int c = 0; c < in.count; c += L::count) {
        out.fetch_some();
        const Triple<L> apart = triple_at<L>(out.normal, c);
        L distance = row_at<L>(out.inverse_distance, c);
        if constexpr (std::is_same_v<L, FloatLanes>) {
            const L reach = distance;
            distance = root(apart.squared());
            put<Number>(row_at<L>(out.overlap, c) / (reach + distance), out.overlap, c);
        }
        const L inverse = L(1.0) / distance;
        put<Number>(apart * inverse, out.normal, c);
        put<Number>(inverse, out.inverse_distance, c);
        if (in.wants >= Wants::spin) put<Number>(distance, out.turn[0], c);
    }
}

// Velocities and spins of grains, numbers of L.
template <class L>
HWY_INLINE const NumberOf<L>* velocities(const Grains& grains) {
    if constexpr (std::is_same_v<L, Lanes>)
        return numbers(grains.motion);
    else
        return grains.rounded.data()->velocity;
}

template <class L>
void sweep_radii(const GeometryInput& in, const Places& at, TouchChunk& out) {
    using Number = NumberOf<L>;
    for (int c = 0; c < in.count; c += L::count) {
        L one, two;
        if constexpr (std::is_same_v<L, Lanes>) {
            one = row_at<L>(out.first_arm, c), two = row_at<L>(out.second_arm, c);
        } else {
            const float* from = velocities<L>(*in.grains) + 4;
            one = load_records<Floats>(from, 2, at.first + c).d;
            two = load_records<Floats>(from, 2, at.second + c).d;
        }
        put<Number>(one * two / (one + two), out.effective_radius, c);
    }
}

template <class L>
void sweep_velocities(const GeometryInput& in, const Places& at, TouchChunk& out) {
    using Number = NumberOf<L>;
    const Number* from = velocities<L>(*in.grains);
    for (int c = 0; c < in.count; c += L::count) {
        out.fetch_some();
        const auto relative = load_relative<typename L::Tag>(from, 2, at.first + c, at.second + c);
        put<Number>(triple(relative), out.velocity, c);
        if (in.mass) put<Number>(L(relative.d), out.inverse_mass, c);
    }
}

// Arms to the plane through the spheres' circle of intersection; they sum to the distance, which is what
// keeps angular momentum. The original program took the radii.
template <class L>
HWY_INLINE void to_contact_plane(L distance, L inverse, L& one, L& two) {
    one = L(0.5) * multiply_add((one - two) * (one + two), inverse, distance);
    two = distance - one;
}

template <class L>
void sweep_spins(const GeometryInput& in, const Places& at, TouchChunk& out) {
    using Number = NumberOf<L>;
    const Number* from = velocities<L>(*in.grains) + 4;
    const L turn(0.5 * in.turns_for), half_step(0.5 * in.step);
    for (int c = 0; c < in.count; c += L::count) {
        out.fetch_some();
        const auto first = load_records<typename L::Tag>(from, 2, at.first + c);
        const auto second = load_records<typename L::Tag>(from, 2, at.second + c);
        const Triple<L> one = triple(first), two = triple(second);
        const Triple<L> k = triple_at<L>(out.normal, c), velocity = triple_at<L>(out.velocity, c);
        const L inverse = row_at<L>(out.inverse_distance, c);
        L first_arm, second_arm;
        if constexpr (std::is_same_v<L, FloatLanes>)
            first_arm = first.d, second_arm = second.d;
        else
            first_arm = row_at<L>(out.first_arm, c), second_arm = row_at<L>(out.second_arm, c);
        if (in.arms == LeverArms::contact_plane)
            to_contact_plane(row_at<L>(out.turn[0], c), inverse, first_arm, second_arm);
        put<Number>(first_arm, out.first_arm, c);
        put<Number>(second_arm, out.second_arm, c);
        const L closing = k.dot(velocity), in_half = half_step * inverse;
        const Triple<L> across = velocity.less(k, closing);
        const Triple<L> spins = (one * first_arm).plus(two, second_arm);
        put<Number>(of_surfaces(velocity, spins, k, across * (turn * inverse)), out.velocity, c);
        const L farther = less_product(L(1.0), L(2.0) * in_half, closing);  // it was, before the step
        put<Number>(turn_of(k, across * (in_half * farther), L(0.5) * half_step * (one + two).dot(k)),
                    out.turn, c);
        if (in.wants == Wants::rolling) put<Number>((one - two).across(k), in.rolling->rate, c);
    }
}

template <class L>
void pairs_at(const GeometryInput& in, double period, TouchChunk& out) {
    const Places at(in.first, in.second, in.count);
    if constexpr (std::is_same_v<L, Lanes>)
        sweep_places(in, at, period, out);
    else
        sweep_rounded_places(in, at, period, out);
    sweep_distances<L>(in, out);
    if (in.radius) sweep_radii<L>(in, at, out);
    if (in.wants >= Wants::velocity || in.mass) sweep_velocities<L>(in, at, out);
    if (in.wants >= Wants::spin) sweep_spins<L>(in, at, out);
}

void pairs(const GeometryInput& in, double period, TouchChunk& out) {
    in.rounded ? pairs_at<FloatLanes>(in, period, out) : pairs_at<Lanes>(in, period, out);
}

// A grain and a wall, plane or round.
struct AtWall {
    Triple<Lanes> out_from_axis;
    Lanes from_axis, distance, radius;
    LanesMask round;
};
HWY_INLINE AtWall at_wall(const double* place, const WallState& walls, const std::int32_t* i,
                          const std::int32_t* face, Triple<Lanes>& into) {
    const Lanes zero(0.0);
    const auto grain = load_records(place, 4, i);
    const auto plane = load_records(numbers(walls.faces), 8, face);
    const Triple<Lanes> centre = triple(grain);
    into = triple(plane);
    AtWall w{{zero, zero, zero}, zero, into.dot(centre) - Lanes(plane.d), Lanes(grain.d), zero > zero};
    if (!walls.any_round) return w;
    const auto cylinder = load_records(numbers(walls.faces) + 4, 8, face);
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

        const auto motion_one = load_records(motion, 8, i);
        if (in.mass) put<Number>(Lanes(motion_one.d), out.inverse_mass, c);
        if constexpr (wants == Wants::overlap) continue;

        Triple<Lanes> velocity = triple(motion_one) - triple(load_records(numbers(walls.motion), 8, face));
        if constexpr (wants >= Wants::spin) {
            const Lanes arm = in.arms == LeverArms::contact_plane ? distance : radius;
            const Triple<Lanes> rate = triple(load_records(motion + 4, 8, i));
            // Along a cylinder's wall k turns with the grain about the axis; a plane's does not turn.
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

HWY_EXPORT(pairs_within);
HWY_EXPORT(walls_that_touch);
HWY_EXPORT(pairs);
HWY_EXPORT(walls);

std::uint64_t near_pairs(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                         int count, double period, double gap) {
    return HWY_DYNAMIC_DISPATCH(pairs_within)(grains, first, second, count, period, gap);
}

std::uint64_t touching_walls(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const WallState& walls) {
    return HWY_DYNAMIC_DISPATCH(walls_that_touch)(grains, first, second, count, walls);
}

void touch_pairs(const GeometryInput& in, double period, TouchChunk& out) {
    HWY_DYNAMIC_DISPATCH(pairs)(in, period, out);
}

void touch_walls(const GeometryInput& in, const WallState& state, TouchChunk& out) {
    HWY_DYNAMIC_DISPATCH(walls)(in, state, out);
}

}  // namespace grainreel
#endif
