// Adds the loads of meshes as point_loads.cpp does, for a register of contacts at once.
#include <algorithm>

#include "engine/step/forces/loads.hpp"
#include "engine/step/lists/contact_rules.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/forces/mesh_loads.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/forces/loads-inl.hpp"
#include "engine/step/grid/places-inl.hpp"
#include "engine/vector/plain-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE Triple<Lanes> all_lanes(const Vec3& v) {
    return {Lanes(v.x()), Lanes(v.y()), Lanes(v.z())};
}

// Loads numbers of a row as doubles, whether the row holds doubles or floats.
template <class Number>
HWY_INLINE Lanes wide_row(const Row& row, int c) {
    if constexpr (std::is_same_v<Number, float>) {
        const hn::Rebind<float, Doubles> floats;
        return hn::PromoteTo(Doubles(), hn::Load(floats, row.floats + c));
    } else {
        return load(row.doubles + c);
    }
}
template <class Number>
HWY_INLINE Triple<Lanes> wide_triple(const Row* rows, int c) {
    return {wide_row<Number>(rows[0], c), wide_row<Number>(rows[1], c), wide_row<Number>(rows[2], c)};
}

// Adds the forces of kLanes contacts from c on, all with one mesh.
template <class Number, bool rubs>
HWY_INLINE void add_register(const WallLoads& in, const WallPose& pose, int c) {
    const ChunkOfContacts& chunk = in.contacts;
    const Lanes zero(0.0), normal = wide_row<Number>(chunk.force->normal, c);
    const Triple<Lanes> k = wide_triple<Number>(chunk.touch->normal, c);
    Triple<Lanes> force = k * normal, couple{zero, zero, zero}, torque = couple;
    if constexpr (rubs) {
        const Triple<Lanes> across = wide_triple<Number>(chunk.force->tangential, c);
        force += across;
        if (chunk.rolling) couple = wide_triple<Number>(chunk.rolling->torque, c);
        torque = plain_cross(k, across) * wide_row<Number>(chunk.touch->first_arm, c) + couple;
    }
    const auto place = load_bundles(numbers(in.grains.place), 4, chunk.first + c);
    const Lanes reach = Lanes(place.d) - wide_row<Number>(chunk.touch->overlap, c);
    const Triple<Lanes> from = triple(place) + k * reach - all_lanes(pose.now.place),
                        spin = all_lanes(pose.now.spin);
    const Triple<Lanes> velocity = all_lanes(pose.now.velocity) + plain_cross(spin, from);
    alignas(64) double work[kLanes];
    store(Lanes(in.step) * (plain_dot(force, velocity) + plain_dot(couple, spin)), work);
    const auto lost = by_contact<rubs>(force, torque);
    each_of<Lanes>(chunk.count - c, [&]<int n>() HWY_ATTR {
        if (!chunk.touch->touches(c + n)) return;
        const std::int32_t grain = chunk.first[c + n];
        take_off(numbers(in.grains.load[grain]), lost.template row<n>());
        in.grains.wall_work[grain] -= work[n];
    });
}

template <class Number, bool rubs>
void meshes_of(const WallLoads& in) {
    const ChunkOfContacts& chunk = in.contacts;
    for (int c = 0; c < chunk.count; c += kLanes) {
        const std::int32_t mesh = mesh_of(chunk.second[c]);
        bool is_one = true;
        for (int k = 1; k < kLanes; ++k) is_one &= mesh_of(chunk.second[c + k]) == mesh;
        if (is_one) {
            add_register<Number, rubs>(in, in.walls.pose_of_mesh(mesh), c);
            continue;
        }
        for (int k = c; k < std::min(c + kLanes, chunk.count); ++k)
            if (chunk.touch->touches(k)) add_at_point(in, true, k);
    }
}

template <class Number>
void meshes_in(const WallLoads& in) {
    in.contacts.rubs ? meshes_of<Number, true>(in) : meshes_of<Number, false>(in);
}

void add_to_meshes(const WallLoads& in) {
    in.contacts.rounded ? meshes_in<float>(in) : meshes_in<double>(in);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(add_to_meshes);

// If the forces on walls are tallied, each force is needed by itself, so the contacts are taken one by one.
void add_at_meshes(const WallLoads& forces) {
    if (forces.walls.tally) return add_at_points(forces, true);
    HWY_DYNAMIC_DISPATCH(add_to_meshes)(forces);
}

}  // namespace grainreel
#endif
