// The geometry of contacts between a grain and a mesh. PatchMatcher (forces/law_input.hpp) says where they
// touch. The results are those of touch_point() to the bit, because nothing is fused.
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/geometry/wall_point.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/geometry/mesh_geometry.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/geometry/rows-inl.hpp"
#include "engine/vector/plain-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Rounds numbers as the rows do; see as_held() in wall_point.cpp.
template <class Number>
HWY_INLINE Lanes as_held(Lanes a) {
    if constexpr (std::is_same_v<Number, float>) {
        const hn::Rebind<float, Doubles> floats;
        return hn::PromoteTo(Doubles(), hn::DemoteTo(floats, a.value));
    } else {
        return a;
    }
}
template <class Number>
HWY_INLINE Triple<Lanes> as_held(const Triple<Lanes>& t) {
    return {as_held<Number>(t.x), as_held<Number>(t.y), as_held<Number>(t.z)};
}

// turn_of() of wall_point.cpp, for a register of contacts.
HWY_INLINE Triple<Lanes> turn_between(const Triple<Lanes>& before, const Triple<Lanes>& k, Lanes twist) {
    const Triple<Lanes> across = plain_cross(before, k), b = k * twist;
    const Lanes whole = Lanes(1.0) + plain_dot(before, k);
    const Triple<Lanes> a{across.x / whole, across.y / whole, across.z / whole};
    return a + b + plain_cross(b, a);
}

// Copies that fill the last block are MeshTouch as well.
template <Wants wants, class Number>
void meshes_chunk(const GeometryInput& in, const MeshTouch* at, TouchChunk& out) {
    HWY_ALIGN static constexpr std::int32_t in_turn[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const double* motion = numbers(in.grains->motion);
    const Lanes zero(0.0), half(0.5), twist_share(0.25 * in.step);
    out.touching = 0;
    for (int c = 0; c < whole_blocks(in.count); c += kLanes) {
        const std::int32_t* i = in.first + c;
        const double* const touch = reinterpret_cast<const double*>(at + c);
        const auto part = [&](MeshTouch::Part one)
                              HWY_ATTR { return load_bundles(touch + one, MeshTouch::kNumbers, in_turn); };
        const auto place = part(MeshTouch::kNormal);
        const Lanes distance(place.d), radius(load_bundles(numbers(in.grains->place), kPlaceNumbers, i).d);
        const Lanes overlap = select(distance < Lanes(MeshTouch::kApart), radius - distance, Lanes(-1.0));
        put<Number>(overlap, out.overlap, c);
        const LanesMask touching = overlap > zero;
        if (none(touching)) continue;
        out.touching |= bits(touching) << c;
        const Triple<Lanes> k = as_held<Number>(triple(place));
        put<Number>(k, out.normal, c);
        if (in.radius) put<Number>(radius, out.effective_radius, c);
        if (wants == Wants::overlap && !in.mass) continue;

        const auto motion_one = load_bundles(motion, kMotionNumbers, i);
        if (in.mass) put<Number>(Lanes(motion_one.d), out.inverse_mass, c);
        if constexpr (wants == Wants::overlap) continue;

        Triple<Lanes> velocity = triple(motion_one) - triple(part(MeshTouch::kVelocity));
        if constexpr (wants >= Wants::spin) {
            const Lanes arm = in.arms == LeverArms::contact_plane ? distance : radius;
            const Triple<Lanes> kept = triple(part(MeshTouch::kNormalBefore)),
                                spin = triple(load_bundles(motion + kSpinOfMotion, kMotionNumbers, i)),
                                of_wall = triple(part(MeshTouch::kSpin));
            const LanesMask is_new = (kept.x == zero) & (kept.y == zero) & (kept.z == zero);
            const Triple<Lanes> before = in.step == 0 ? k : select(is_new, k, as_held<Number>(kept));
            // `change` leads from k to the normal at the step's middle, where velocities lag behind
            // positions.
            const Triple<Lanes> change =
                in.turns_for > 0 ? (before - k) * half : Triple<Lanes>{zero, zero, zero};
            put<Number>(turn_between(before, k, twist_share * plain_dot(spin + of_wall, k)), out.turn, c);
            velocity = velocity - change * plain_dot(k, velocity) + plain_cross(spin * arm, k + change);
            put<Number>(arm, out.first_arm, c);
            if constexpr (wants == Wants::rolling) {
                const Triple<Lanes> rate = spin - of_wall;
                put<Number>(rate - k * plain_dot(k, rate), in.rolling->rate, c);
            }
        }
        put<Number>(velocity, out.velocity, c);
    }
}

template <class Number>
void meshes_in(const GeometryInput& in, const MeshTouch* at, TouchChunk& out) {
    switch (in.wants) {
        case Wants::overlap:
            return meshes_chunk<Wants::overlap, Number>(in, at, out);
        case Wants::velocity:
            return meshes_chunk<Wants::velocity, Number>(in, at, out);
        case Wants::spin:
            return meshes_chunk<Wants::spin, Number>(in, at, out);
        case Wants::rolling:
            return meshes_chunk<Wants::rolling, Number>(in, at, out);
    }
}

void meshes(const GeometryInput& in, const MeshTouch* at, TouchChunk& out) {
    in.rounded ? meshes_in<float>(in, at, out) : meshes_in<double>(in, at, out);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(meshes);

void touch_meshes(const GeometryInput& in, const MeshTouch* at, TouchChunk& out) {
    HWY_DYNAMIC_DISPATCH(meshes)(in, at, out);
}

}  // namespace grainreel
#endif
