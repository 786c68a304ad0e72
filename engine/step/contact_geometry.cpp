#include "engine/step/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/contact_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/row-inl.hpp"
#include "engine/vector/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class Record>
HWY_INLINE const double* numbers(const std::vector<Record>& records) {
    return reinterpret_cast<const double*>(records.data());
}

template <class D>
HWY_INLINE Triple<LanesOf<D>> triple(const Four<D>& f) {
    return {LanesOf<D>(f.a), LanesOf<D>(f.b), LanesOf<D>(f.c)};
}

HWY_INLINE Lanes nearest(Lanes x, Lanes period) {
    const Lanes half = period * Lanes(0.5);
    const Lanes low = select(x > half, x - period, x);
    return select(x < -half, x + period, low);
}

// Of i's surface against j's, the centres' velocity and the spins' share of it being those of the middle of
// the step, k that of its end. In the middle it was k + change: the velocity is taken with that and given
// with k in its place, or a pair that turns as one body would slip by its angle a step (Vyas et al., Comput.
// Phys. Commun. 310, 109524: time levels).
template <class L>
HWY_INLINE Triple<L> of_surfaces(const Triple<L>& velocity, const Triple<L>& spins, const Triple<L>& k,
                                 const Triple<L>& change) {
    return velocity.less(change, k.dot(velocity)) + spins.cross(k + change);
}

std::uint64_t pairs_that_touch(const Grains& grains, const std::int32_t* i, const std::int32_t* j, int count,
                               double period) {
    const double* place = numbers(grains.place);
    std::uint64_t touching = 0;
    for (int c = 0; c < count; c += kLanes) {
        const auto one = load_records(place, 4, i + c), two = load_records(place, 4, j + c);
        Triple<Lanes> apart = triple(two) - triple(one);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes reach = Lanes(one.d) + Lanes(two.d);
        touching |= bits(apart.squared() < reach * reach) << c;
    }
    return touching;
}

// As many contacts as laws may read: of what fills the last block, too, is known whether it touches.
HWY_INLINE int whole_blocks(int count) {
    return (count + kBlock - 1) / kBlock * kBlock;
}

// Where the places of a chunk's bodies start, in doubles, worked out once: their motion starts twice as far.
struct Places {
    alignas(64) std::int32_t first[kChunk], second[kChunk];

    HWY_INLINE explicit Places(const GeometryInput& in) {
        constexpr std::int32_t stride = sizeof(Place) / sizeof(double);
        for (int c = 0; c < in.count; ++c) {
            first[c] = stride * in.first[c];
            second[c] = stride * in.second[c];
        }
        // Up to a whole register.
        for (int c = in.count; c % kBlock != 0; ++c) first[c] = first[c - 1], second[c] = second[c - 1];
    }
};
static_assert(sizeof(Motion) == 2 * sizeof(Place) && sizeof(RoundedMotion) == sizeof(Place));

// A chunk goes through in sweeps, as many as its law wants: places, velocities, spins. (One sweep for all was
// no faster.) Lengths between places are taken as doubles, the rest as L.
//
// Distances, for now where inverse distances and normals will be, and overlaps.
template <class L>
void sweep_places(const GeometryInput& in, const Places& at, double period, TouchChunk& out) {
    using Number = NumberOf<L>;
    const double* place = numbers(in.grains->place);
    out.touching = 0;
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const auto one = load_records(place, 1, at.first + c), two = load_records(place, 1, at.second + c);
        Triple<Lanes> apart = triple(two) - triple(one);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes radius_one(one.d), radius_two(two.d), distance = root(apart.squared());
        const Lanes overlap = radius_one + radius_two - distance;
        out.touching |= bits(overlap > Lanes(0.0)) << c;
        put<Number>(overlap, out.overlap, c);
        put<Number>(apart, out.normal, c);
        put<Number>(distance, out.inverse_distance, c);
        if (in.radius) {
            const Lanes inverse = Lanes(1.0) / radius_one + Lanes(1.0) / radius_two;
            put<Number>(Lanes(1.0) / inverse, out.effective_radius, c);
        }
        if (in.wants < Wants::spin) continue;
        put<Number>(radius_one, out.first_arm, c);
        put<Number>(radius_two, out.second_arm, c);
    }
}

// Arms to the plane through the spheres' circle of intersection; they sum to the distance, which is what
// keeps angular momentum. The original program took the radii.
template <class L>
void sweep_distances(const GeometryInput& in, TouchChunk& out) {
    using Number = NumberOf<L>;
    const bool arms = in.wants >= Wants::spin && in.arms == LeverArms::contact_plane;
    for (int c = 0; c < in.count; c += L::count) {
        const L distance = row_at<L>(out.inverse_distance, c), inverse = L(1.0) / distance;
        put<Number>(triple_at<L>(out.normal, c) * inverse, out.normal, c);
        put<Number>(inverse, out.inverse_distance, c);
        if (!arms) continue;
        const L one = row_at<L>(out.first_arm, c), two = row_at<L>(out.second_arm, c);
        const L first_arm = L(0.5) * multiply_add((one - two) * (one + two), inverse, distance);
        put<Number>(first_arm, out.first_arm, c);
        put<Number>(distance - first_arm, out.second_arm, c);
    }
}

// Velocities and spins of grains, numbers of L.
template <class L>
HWY_INLINE Four<typename L::Tag> velocities_of(const Grains& grains, const std::int32_t* at) {
    if constexpr (std::is_same_v<L, Lanes>)
        return load_records(numbers(grains.motion), 2, at);
    else
        return load_records<typename L::Tag>(grains.rounded.data()->velocity, 2, at);
}
template <class L>
HWY_INLINE Triple<L> spins_of(const Grains& grains, const std::int32_t* at) {
    if constexpr (std::is_same_v<L, Lanes>)
        return triple(load_records(numbers(grains.motion) + 4, 2, at));
    else
        return triple(load_records<typename L::Tag>(grains.rounded.data()->spin, 2, at));
}

template <class L>
void sweep_velocities(const GeometryInput& in, const Places& at, TouchChunk& out) {
    using Number = NumberOf<L>;
    for (int c = 0; c < in.count; c += L::count) {
        const auto one = velocities_of<L>(*in.grains, at.first + c);
        const auto two = velocities_of<L>(*in.grains, at.second + c);
        put<Number>(triple(one) - triple(two), out.velocity, c);
        if (in.mass) put<Number>(L(one.d) + L(two.d), out.inverse_mass, c);
    }
}

template <class L>
void sweep_spins(const GeometryInput& in, const Places& at, TouchChunk& out) {
    using Number = NumberOf<L>;
    const L turn(0.5 * in.turns_for), half_step(0.5 * in.step);
    for (int c = 0; c < in.count; c += L::count) {
        const Triple<L> one = spins_of<L>(*in.grains, at.first + c);
        const Triple<L> two = spins_of<L>(*in.grains, at.second + c);
        const Triple<L> k = triple_at<L>(out.normal, c), velocity = triple_at<L>(out.velocity, c);
        const L turning = turn * row_at<L>(out.inverse_distance, c);
        const Triple<L> change = velocity.across(k) * turning;
        const Triple<L> spins = (one * row_at<L>(out.first_arm, c)).plus(two, row_at<L>(out.second_arm, c));
        put<Number>(of_surfaces(velocity, spins, k, change), out.velocity, c);
        put<Number>(half_step * (one + two).dot(k), out.twist, c);
        if (in.wants == Wants::rolling) put<Number>((one - two).across(k), in.rolling->rate, c);
    }
}

template <class L>
void pairs_at(const GeometryInput& in, double period, TouchChunk& out) {
    const Places at(in);
    sweep_places<L>(in, at, period, out);
    sweep_distances<L>(in, out);
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
    const auto grain = load_records(place, 4, i);
    const auto plane = load_records(numbers(walls.faces), 8, face);
    const auto cylinder = load_records(numbers(walls.faces) + 4, 8, face);
    const Triple<Lanes> centre = triple(grain);
    into = triple(plane);
    AtWall w;
    w.radius = Lanes(grain.d);
    w.out_from_axis = centre - triple(cylinder);
    w.out_from_axis.z = Lanes(0.0);
    w.from_axis = root(w.out_from_axis.squared());
    w.round = Lanes(cylinder.d) > Lanes(0.0);
    w.distance = select(w.round, Lanes(cylinder.d) - w.from_axis, into.dot(centre) - Lanes(plane.d));
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
    const Lanes turn(0.5 * in.turns_for);
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const std::int32_t *i = in.first + c, *face = in.second + c;
        Triple<Lanes> into;
        const auto [out_from_axis, from_axis, distance, radius, round] = at_wall(place, walls, i, face, into);
        const Lanes overlap = radius - distance;
        put<Number>(overlap, out.overlap, c);
        const LanesMask touching = overlap > Lanes(0.0);
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;

        const Lanes inverse = select(from_axis > Lanes(0.0), Lanes(1.0) / from_axis, Lanes(0.0));
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
            Triple<Lanes> change = velocity.across(k) * select(round, -turn * inverse, Lanes(0.0));
            change.z = Lanes(0.0);
            velocity = of_surfaces(velocity, rate * arm, k, change);
            put<Number>(arm, out.first_arm, c);
            put<Number>(Lanes(0.5 * in.step) * rate.dot(k), out.twist, c);
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

HWY_EXPORT(pairs_that_touch);
HWY_EXPORT(walls_that_touch);
HWY_EXPORT(pairs);
HWY_EXPORT(walls);

std::uint64_t touching_pairs(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, double period) {
    return HWY_DYNAMIC_DISPATCH(pairs_that_touch)(grains, first, second, count, period);
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
