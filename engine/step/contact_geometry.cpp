#include "engine/step/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/contact_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/vector/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class Record>
HWY_INLINE const double* numbers(const std::vector<Record>& records) {
    return reinterpret_cast<const double*>(records.data());
}

HWY_INLINE void put(const Triple<Lanes>& t, double (*to)[kChunk], int c) {
    store(t.x, to[0] + c), store(t.y, to[1] + c), store(t.z, to[2] + c);
}

HWY_INLINE Triple<Lanes> triple(const Four<Doubles>& f) {
    return {Lanes(f.a), Lanes(f.b), Lanes(f.c)};
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
HWY_INLINE Triple<Lanes> of_surfaces(const Triple<Lanes>& velocity, const Triple<Lanes>& spins,
                                     const Triple<Lanes>& k, const Triple<Lanes>& change) {
    return velocity - change * k.dot(velocity) + spins.cross(k + change);
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

HWY_INLINE Triple<Lanes> triple_at(const double (*from)[kChunk], int c) {
    return {load(from[0] + c), load(from[1] + c), load(from[2] + c)};
}

// A chunk goes through in sweeps, as many as its law wants: places, velocities, spins. (One sweep for all was
// no faster.)
void sweep_places(const GeometryInput& in, double period, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    out.touching = 0;
    for (int c = 0; c < in.count; c += kLanes) {
        const auto one = load_records(place, 4, in.first + c), two = load_records(place, 4, in.second + c);
        Triple<Lanes> apart = triple(two) - triple(one);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes radius_one(one.d), radius_two(two.d), squared = apart.squared();
        const Lanes distance = root(squared), overlap = radius_one + radius_two - distance;
        const Lanes inverse_distance = distance * (Lanes(1.0) / squared);  // need not wait for the root
        store(overlap, out.overlap + c);
        out.touching |= bits(overlap > Lanes(0.0)) << c;
        put(apart * inverse_distance, out.normal, c);
        if (in.radius)
            store(Lanes(1.0) / (Lanes(1.0) / radius_one + Lanes(1.0) / radius_two), out.effective_radius + c);
        if (in.wants < Wants::spin) continue;
        // Arms to the plane through the spheres' circle of intersection; they sum to the distance, which is
        // what keeps angular momentum. The original program took the radii.
        Lanes first_arm = radius_one, second_arm = radius_two;
        if (in.arms == LeverArms::contact_plane) {
            first_arm = Lanes(0.5) *
                        (distance + (radius_one - radius_two) * (radius_one + radius_two) * inverse_distance);
            second_arm = distance - first_arm;
        }
        store(first_arm, out.first_arm + c);
        store(second_arm, out.second_arm + c);
        store(inverse_distance, out.inverse_distance + c);
    }
}

void sweep_velocities(const GeometryInput& in, TouchChunk& out) {
    const double* motion = numbers(in.grains->motion);
    for (int c = 0; c < in.count; c += kLanes) {
        const auto one = load_records(motion, 4, in.first + c), two = load_records(motion, 4, in.second + c);
        put(triple(one) - triple(two), out.velocity, c);
        if (in.mass) store(Lanes(1.0) / (Lanes(one.d) + Lanes(two.d)), out.effective_mass + c);
    }
}

void sweep_spins(const GeometryInput& in, TouchChunk& out) {
    const double* spin = numbers(in.grains->spin);
    const Lanes turn(0.5 * in.turns_for), half_step(0.5 * in.step);
    for (int c = 0; c < in.count; c += kLanes) {
        const Triple<Lanes> one = triple(load_records(spin, 4, in.first + c));
        const Triple<Lanes> two = triple(load_records(spin, 4, in.second + c));
        const Triple<Lanes> k = triple_at(out.normal, c), velocity = triple_at(out.velocity, c);
        const Lanes turning = turn * load(out.inverse_distance + c);
        const Triple<Lanes> change = (velocity - k * k.dot(velocity)) * turning;
        const Triple<Lanes> spins = one * load(out.first_arm + c) + two * load(out.second_arm + c);
        put(of_surfaces(velocity, spins, k, change), out.velocity, c);
        store(half_step * (one + two).dot(k), out.twist + c);
        if (in.wants == Wants::rolling) {
            const Triple<Lanes> rolling = one - two;
            put(rolling - k * k.dot(rolling), in.rolling->rate, c);
        }
    }
}

void pairs(const GeometryInput& in, double period, TouchChunk& out) {
    sweep_places(in, period, out);
    if (in.wants >= Wants::velocity || in.mass) sweep_velocities(in, out);
    if (in.wants >= Wants::spin) sweep_spins(in, out);
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

template <Wants wants>
void walls_chunk(const GeometryInput& in, const WallState& walls, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    const double* motion = numbers(in.grains->motion);
    const double* spin = numbers(in.grains->spin);
    out.touching = 0;
    const Lanes turn(0.5 * in.turns_for);
    for (int c = 0; c < in.count; c += kLanes) {
        const std::int32_t *i = in.first + c, *face = in.second + c;
        Triple<Lanes> into;
        const auto [out_from_axis, from_axis, distance, radius, round] = at_wall(place, walls, i, face, into);
        const Lanes overlap = radius - distance;
        store(overlap, out.overlap + c);
        const LanesMask touching = overlap > Lanes(0.0);
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;

        const Lanes inverse = select(from_axis > Lanes(0.0), Lanes(1.0) / from_axis, Lanes(0.0));
        const Triple<Lanes> k = select(round, out_from_axis * inverse, -into);
        put(k, out.normal, c);
        if (in.radius) store(Lanes(1.0) / (Lanes(1.0) / radius), out.effective_radius + c);
        if (wants == Wants::overlap && !in.mass) continue;

        const auto motion_one = load_records(motion, 4, i);
        if (in.mass) store(Lanes(1.0) / Lanes(motion_one.d), out.effective_mass + c);
        if constexpr (wants == Wants::overlap) continue;

        Triple<Lanes> velocity = triple(motion_one) - triple(load_records(numbers(walls.motion), 8, face));
        if constexpr (wants >= Wants::spin) {
            const Lanes arm = in.arms == LeverArms::contact_plane ? distance : radius;
            const Triple<Lanes> rate = triple(load_records(spin, 4, i));
            // Along a cylinder's wall k turns with the grain about the axis; a plane's does not turn.
            Triple<Lanes> change =
                (velocity - k * k.dot(velocity)) * select(round, -turn * inverse, Lanes(0.0));
            change.z = Lanes(0.0);
            velocity = of_surfaces(velocity, rate * arm, k, change);
            store(arm, out.first_arm + c);
            store(Lanes(0.5 * in.step) * rate.dot(k), out.twist + c);
            if constexpr (wants == Wants::rolling) put(rate - k * k.dot(rate), in.rolling->rate, c);
        }
        put(velocity, out.velocity, c);
    }
}

void walls(const GeometryInput& in, const WallState& state, TouchChunk& out) {
    switch (in.wants) {
        case Wants::overlap:
            return walls_chunk<Wants::overlap>(in, state, out);
        case Wants::velocity:
            return walls_chunk<Wants::velocity>(in, state, out);
        case Wants::spin:
            return walls_chunk<Wants::spin>(in, state, out);
        case Wants::rolling:
            return walls_chunk<Wants::rolling>(in, state, out);
    }
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
