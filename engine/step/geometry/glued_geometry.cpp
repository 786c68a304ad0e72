// The geometry of contacts between grains and glued grains, for a register of contacts at once.
#include "engine/step/geometry/contact_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/geometry/glued_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/geometry/pair_formulas-inl.hpp"
#include "engine/step/geometry/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// A grain and a glued grain: two spheres, of which the second moves with its wall.
struct AtGlued {
    Triple<Lanes> apart;  // from the grain's centre to that of the glued grain
    Lanes distance, radius, other_radius;
};
HWY_INLINE AtGlued at_glued(const double* place, const GluedState& state, const std::int32_t* i,
                            const std::int32_t* j, const std::int32_t* face) {
    const auto grain = load_bundles(place, kPlaceNumbers, i);
    const auto glued = load_bundles(numbers(state.glued.place), 4, j);
    const auto face_point = load_bundles(numbers(state.walls.faces) + 4, 8, face);
    AtGlued at{between(triple(grain), triple(face_point) + triple(glued), state.period), Lanes(0.0),
               Lanes(grain.d), Lanes(glued.d)};
    at.distance = root(at.apart.squared());
    return at;
}

std::uint64_t glued_that_touch(const Grains& grains, const std::int32_t* i, const std::int32_t* j,
                               const std::int32_t* face, int count, const GluedState& state) {
    std::uint64_t touching = 0;
    for (int c = 0; c < count; c += kLanes) {
        const AtGlued at = at_glued(numbers(grains.place), state, i + c, j + c, face + c);
        touching |= bits(at.distance < at.radius + at.other_radius) << c;
    }
    return touching;
}

// Computes what the sweeps of pair_geometry.cpp compute, for a second body that does not spin.
template <class Number>
void glued_chunk(const GeometryInput& in, const GluedState& state, const std::int32_t* face,
                 TouchChunk& out) {
    const double* place = numbers(in.grains->place);
    const double* motion = numbers(in.grains->motion);
    out.touching = 0;
    const Lanes one(1.0);
    const HalfTimes<Lanes> half{Lanes(0.5 * in.turns_for), Lanes(0.5 * in.step)};
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const std::int32_t* i = in.first + c;
        const AtGlued at = at_glued(place, state, i, in.second + c, face + c);
        const Lanes reach = at.radius + at.other_radius, overlap = reach - at.distance;
        put<Number>(overlap, out.overlap, c);
        const LanesMask touching = overlap > Lanes(0.0);
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;

        const Lanes inverse = one / at.distance;
        const Triple<Lanes> k = at.apart * inverse;
        put<Number>(k, out.normal, c);
        if (in.radius) put<Number>(at.radius * at.other_radius / reach, out.effective_radius, c);
        if (in.wants == Wants::overlap && !in.mass) continue;

        const auto motion_one = load_bundles(motion, kMotionNumbers, i);
        if (in.mass) put<Number>(Lanes(motion_one.d), out.inverse_mass, c);
        if (in.wants == Wants::overlap) continue;

        Triple<Lanes> velocity =
            triple(motion_one) - triple(load_bundles(numbers(state.walls.motion), 8, face + c));
        if (in.wants >= Wants::spin) {
            Lanes arm = at.radius;
            if (in.arms == LeverArms::contact_plane)
                arm = Lanes(0.5) * multiply_add((at.radius - at.other_radius) * reach, inverse, at.distance);
            const Triple<Lanes> rate = triple(load_bundles(motion + kSpinOfMotion, kMotionNumbers, i));
            const Swing<Lanes> swing = swing_of_spheres(k, velocity, inverse, half);
            put<Number>(turn_by(swing, rate, k, half), out.turn, c);
            velocity = surface_velocity(velocity, rate * arm, k, swing, half);
            put<Number>(arm, out.first_arm, c);
            if (in.wants == Wants::rolling) put<Number>(rate.across(k), in.rolling->rate, c);
        }
        put<Number>(velocity, out.velocity, c);
    }
}

void touch_all(const GeometryInput& in, const GluedState& state, const std::int32_t* face, TouchChunk& out) {
    in.rounded ? glued_chunk<float>(in, state, face, out) : glued_chunk<double>(in, state, face, out);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(glued_that_touch);
HWY_EXPORT(touch_all);

void find_faces(const GluedGrains& glued, const std::int32_t* second, int count, std::int32_t* face) {
    for (int c = 0; c < (count + kBlock - 1) / kBlock * kBlock; ++c) face[c] = glued.face[second[c]];
}

std::uint64_t touching_glued(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const GluedState& state) {
    std::int32_t face[kChunk];
    find_faces(state.glued, second, count, face);
    return HWY_DYNAMIC_DISPATCH(glued_that_touch)(grains, first, second, face, count, state);
}

void touch_glued(const GeometryInput& in, const GluedState& state, const std::int32_t* face,
                 TouchChunk& out) {
    HWY_DYNAMIC_DISPATCH(touch_all)(in, state, face, out);
}

}  // namespace grainreel
#endif
