#include "engine/step/forces/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/forces/contact_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/row-inl.hpp"
#include "engine/step/grid/places-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Velocity of i's surface against j's surface, from the velocity of the centres and the spins times arms.
// These two belong to the middle of the step, but the normal k belongs to its end. The normal of the middle
// is k + change. So the velocity is computed with k + change, and its normal part is then laid along k.
// Without this, a pair that turns as one body would slip by its angle of turn in every step (Vyas et al.,
// Comput. Phys. Commun. 310, 109524: time levels).
template <class L>
HWY_INLINE Triple<L> of_surfaces(const Triple<L>& velocity, const Triple<L>& spins, const Triple<L>& k,
                                 const Triple<L>& change) {
    return velocity.less(change, k.dot(velocity)) + spins.cross(k + change);
}

// Cayley's vector of a contact's turn during a step. The turn has two parts. The first part takes the old
// normal to k; the old normal is k + 2 `back`, scaled to unit length. Its vector a is taken as tan(angle) / 2
// along the axis, which makes the angle wrong by its cube / 4. The second part is a turn about k, by the
// angle 2 `twist`; its vector is b. Both parts together are a + b + b x a.
// (The old normal is not stored. It follows from the velocities, because the displacement between two forces
// is the velocity times the step.)
template <class L>
HWY_INLINE Triple<L> turn_of(const Triple<L>& k, const Triple<L>& back, L twist) {
    return back.cross(k).plus(k + back, twist);
}

// Where the bodies of a chunk start in the array of places, counted in doubles. In the array of motions they
// start at twice that number. These offsets are computed once for each chunk.
struct Places {
    alignas(64) std::int32_t first[kChunk], second[kChunk];

    HWY_INLINE Places(const std::int32_t* i, const std::int32_t* j, int count) {
        constexpr std::int32_t stride = sizeof(Place) / sizeof(double);
        for (int c = 0; c < count; ++c) {
            first[c] = stride * i[c];
            second[c] = stride * j[c];
        }
        // Copies of the last pair fill the last block.
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

// The number of contacts together with the copies that fill the last block. Laws may read these copies, so it
// is computed for them too whether they touch.
HWY_INLINE int whole_blocks(int count) {
    return (count + kBlock - 1) / kBlock * kBlock;
}

// A chunk passes through sweeps: places, distances, radii, velocities, spins. The law decides which of them
// are needed. (One sweep for all of them was no faster.)
//
// The first sweep sets the overlaps, and finds out which contacts touch. It leaves other numbers in some rows
// until a later sweep replaces them: `normal` holds the vector between the centres, `inverse_distance` holds
// the distance, and the arms hold the radii.
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

// The first sweep where rows hold floats. It takes no root and sets no radii; later sweeps do that. R is the
// sum of the radii, and d is the distance. The difference R^2 - d^2 = (R - d)(R + d) is small. It is computed
// in doubles and then rounded, so that the overlap keeps all its digits. d itself may be rounded before.
// Until the next sweep, `overlap` holds this difference and `inverse_distance` holds R.
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

// The second sweep sets normals and inverse distances, and with floats the overlaps. `turn[0]` holds the
// distance until sweep_spins() replaces it.
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

// The array of velocities and spins whose numbers fit the registers L.
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

// Arms that end at the plane of the circle in which the two spheres intersect. The two arms add up to the
// distance of the centres, and this conserves angular momentum. (The original program used the radii.)
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
        const L farther = less_product(L(1.0), L(2.0) * in_half, closing);  // distance now / before the step
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

// A grain at a wall. The wall is a plane or a cylinder.
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
