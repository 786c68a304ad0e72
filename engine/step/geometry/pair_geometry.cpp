// The geometry of contacts between two grains.
#include "engine/step/geometry/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/geometry/pair_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/geometry/pair_formulas-inl.hpp"
#include "engine/step/geometry/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

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
        const auto relative = load_relative(place, 1, at.second + c, at.first + c);
        Triple<Lanes> apart = triple(relative);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        touching |= bits(are_closer(apart, Lanes(relative.d), Lanes(gap))) << c;
    }
    return touching;
}

// Each chunk goes through several sweeps: places, distances, radii, velocities, spins. The law decides which
// of them are needed. (One sweep for all of them was no faster.)
//
// The first sweep sets the overlaps, and finds out which contacts touch. It leaves other numbers in some rows
// until a later sweep replaces them: `normal` holds the vector between the centres, `inverse_distance` holds
// the distance, and the arms hold the radii.
void sweep_places(const GeometryInput& in, const Places& at, double period, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    out.touching = 0;
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        out.fetch_some();
        const auto one = load_bundles(place, 1, at.first + c), two = load_bundles(place, 1, at.second + c);
        const Triple<Lanes> apart = between(triple(one), triple(two), period);
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
// in doubles and then rounded, so that the overlap keeps all its digits. d itself may be rounded at once.
// Until the next sweep, `overlap` holds this difference and `inverse_distance` holds R.
void sweep_rounded_places(const GeometryInput& in, const Places& at, double period, TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    out.touching = 0;
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        out.fetch_some();
        const auto relative = load_relative(place, 1, at.second + c, at.first + c);
        Triple<Lanes> apart = triple(relative);
        if (period > 0) apart.x = nearest(apart.x, Lanes(period));
        const Lanes reach(relative.d), difference = reach * reach - apart.squared();
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

// The array of velocities and spins whose numbers have the type of L.
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
            one = load_bundles<Floats>(from, 2, at.first + c).d;
            two = load_bundles<Floats>(from, 2, at.second + c).d;
        }
        put<Number>(effective_radius_of(one, two), out.effective_radius, c);
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

template <class L>
void sweep_spins(const GeometryInput& in, const Places& at, TouchChunk& out) {
    using Number = NumberOf<L>;
    const Number* from = velocities<L>(*in.grains) + 4;
    const HalfTimes<L> half{L(0.5 * in.turns_for), L(0.5 * in.step)};
    for (int c = 0; c < in.count; c += L::count) {
        out.fetch_some();
        const auto first = load_bundles<typename L::Tag>(from, 2, at.first + c);
        const auto second = load_bundles<typename L::Tag>(from, 2, at.second + c);
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
        const Swing<L> swing = swing_of_spheres(k, velocity, inverse, half);
        const Triple<L> spins = (one * first_arm).plus(two, second_arm);
        put<Number>(surface_velocity(velocity, spins, k, swing, half), out.velocity, c);
        put<Number>(turn_by(swing, one + two, k, half), out.turn, c);
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

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(pairs_within);
HWY_EXPORT(pairs);

std::uint64_t near_pairs(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                         int count, double period, double gap) {
    return HWY_DYNAMIC_DISPATCH(pairs_within)(grains, first, second, count, period, gap);
}

void touch_pairs(const GeometryInput& in, double period, TouchChunk& out) {
    HWY_DYNAMIC_DISPATCH(pairs)(in, period, out);
}

}  // namespace grainreel
#endif
