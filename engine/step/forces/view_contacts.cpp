#include "engine/step/forces/view_contacts.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "engine/step/forces/contact_forces.hpp"
#include "engine/step/forces/law_input.hpp"

namespace grainreel {

namespace {

// The wall that a second body is or belongs to.
std::int32_t wall_of(const ForceInput& in, const ContactGroup& group, std::int32_t second) {
    if (group.of_mesh) return static_cast<std::int32_t>(in.walls.faces.size()) + mesh_of(second);
    return group.of_glued ? in.glued.face[second] : second;
}

ContactView view_of(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, int at,
                    const ChunkMemory& of, const EnergyChunk& energy) {
    const auto vector = [at](const Row* axes) { return Vec3(axes[0][at], axes[1][at], axes[2][at]); };
    const std::int32_t first = chunk.first[at], second = chunk.second[at];
    const Place& one = in.grains.place[first];
    ContactView v{};
    v.first = first;
    v.glued = group.of_glued ? second : -1;
    v.second = group.of_pairs ? second : -1 - wall_of(in, group, second);
    v.triangle = chunk.mesh ? static_cast<std::int32_t>(chunk.mesh[at].triangle) : -1;
    v.normal = vector(of.touch.normal);
    v.overlap = of.touch.overlap[at];
    v.smaller_radius = one.radius;
    if (group.of_pairs) v.smaller_radius = std::min(one.radius, in.grains.place[second].radius);
    if (group.of_glued) v.smaller_radius = std::min(one.radius, in.glued.place[second].radius);
    v.normal_force = of.force.normal[at];
    v.tangential = group.law->rubs ? vector(of.force.tangential) : Vec3::Zero();
    const Vec3 turning = v.normal.cross(v.tangential);
    const Vec3 rolling = group.rolling ? vector(of.rolling.torque) : Vec3::Zero();
    v.torque_on_first = v.torque_on_second = Vec3::Zero();
    if (group.law->rubs) v.torque_on_first = -of.touch.first_arm[at] * turning - rolling;
    if (group.law->rubs && group.of_pairs) v.torque_on_second = -of.touch.second_arm[at] * turning + rolling;
    v.stored_energy = energy.stored[at];
    v.sideways_energy = energy.sideways[at];
    v.latched_energy = energy.latched[at];
    v.damping_power = energy.damping[at];
    v.rubbing_power = energy.rubbing[at];
    // On a mesh it is the point of the surface, elsewhere the middle of the overlap.
    v.point = one.position + v.normal * (one.radius - (group.of_mesh ? 1.0 : 0.5) * v.overlap);
    return v;
}

// Shows the contacts of a chunk that touch and whose first body is an own grain.
template <class See>
void see_chunk(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, const void* history,
               std::int32_t first_own, ChunkMemory& memory, const See& see) {
    EnergyChunk energy;
    const LawInput law = law_input(in, group, chunk, false, memory);
    group.law->observe(law, history, memory.force, energy);
    if (group.rolling)
        group.rolling->observe(for_rolling(group, law), behind_law(group, history), memory.force, energy);
    for (int k = 0; k < chunk.count; ++k) {
        if ((memory.touch.touching >> k & 1) && chunk.first[k] >= first_own)
            see(view_of(in, group, chunk, k, memory, energy));
    }
}

// Shows a contact that has no history.
template <class See>
void see_alone(const ForceInput& in, const ContactGroup& group, std::int32_t one, std::int32_t other,
               const MeshTouch* mesh, std::int32_t first_own, ChunkMemory& memory, const See& see) {
    Histories none;
    none.shape(group.history_size(), group.number_size());
    none.resize(kBlock);
    std::int32_t first[kBlock], second[kBlock];
    std::fill_n(first, kBlock, one);
    std::fill_n(second, kBlock, other);
    MeshTouch touch[kBlock];
    if (mesh) touch[0] = *mesh;
    see_chunk(in, group, {first, second, first, second, 1, mesh ? touch : nullptr}, none.of_block(0),
              first_own, memory, see);
}

// Positions may have moved on since the forces. So some candidates may touch that have no contact yet.
template <class See>
void see_candidates(const ForceInput& in, std::size_t g, const ThreadContacts& contacts, ChunkMemory& memory,
                    const See& see) {
    const ContactGroup& group = in.rules.groups[g];
    const ContactTable& table = contacts.tables[g];
    for (std::int32_t c = 0; c < table.candidates(); c += kChunk) {
        const Halo::Bodies bodies{table.near_first() + c, table.near_second() + c};
        std::uint64_t left = which_touch(in, group, bodies, std::min(kChunk, table.candidates() - c));
        for (left &= ~table.admitted(c); left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            see_alone(in, group, bodies.first[k], bodies.second[k], nullptr, contacts.begin, memory, see);
        }
    }
}

// Where the contacts with meshes touch now. Shows what touches without a contact.
template <class See>
std::vector<MeshTouch> see_new_patches(const ForceInput& in, std::size_t g, const ThreadContacts& contacts,
                                       ChunkMemory& memory, const See& see) {
    const ContactGroup& group = in.rules.groups[g];
    const ContactTable& table = contacts.tables[g];
    const MeshLists& lists = contacts.meshes[g];
    std::vector<MeshTouch> touch(MeshLists::places_for(table.size()));
    for (const MeshNear& near : lists.near) {
        for (const MatchedPatch& patch : memory.matcher.match(in, in.meshes, group, near, lists, table)) {
            const std::int32_t second = near.mesh * kMostPatches + patch.number;
            if (patch.goes_on)
                touch[static_cast<std::size_t>(near.contact[patch.number])] = patch.touch;
            else
                see_alone(in, group, near.grain, second, &patch.touch, contacts.begin, memory, see);
        }
    }
    return touch;
}

}  // namespace

void view_contacts(const ForceInput& in, std::size_t g, const ThreadContacts& contacts,
                   const std::function<void(const ContactView&)>& in_order,
                   const std::function<void(const ContactView&)>& late) {
    ChunkMemory memory;
    const ContactTable& table = contacts.tables[g];
    std::vector<MeshTouch> touch;
    if (in.rules.groups[g].of_mesh) touch = see_new_patches(in, g, contacts, memory, late);
    table.each_chunk([&](std::int32_t c, int count) {
        const std::int32_t *const first = table.first() + c, *const second = table.second() + c;
        const MeshTouch* const mesh = touch.empty() ? nullptr : touch.data() + c;
        see_chunk(in, in.rules.groups[g], {first, second, first, second, count, mesh},
                  table.histories().of_block(c), contacts.begin, memory,
                  c < table.sorted() ? in_order : late);
    });
    see_candidates(in, g, contacts, memory, late);
}

}  // namespace grainreel
