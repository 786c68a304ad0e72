#include "engine/step/forces/view_contacts.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "engine/step/forces/law_input.hpp"
#include "engine/step/forces/new_contacts.hpp"

namespace grainreel {

namespace {

ContactView view_of(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, int at,
                    const ChunkMemory& of, const EnergyChunk& energy) {
    const auto vector = [at](const Row* axes) { return Vec3(axes[0][at], axes[1][at], axes[2][at]); };
    const std::int32_t first = chunk.first[at], second = chunk.second[at];
    const Place& one = in.grains.place[first];
    ContactView v{};
    v.first = first;
    v.glued = group.of_glued ? second : -1;
    v.second = group.of_pairs ? second : -1 - (group.of_glued ? in.glued.face[second] : second);
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
    v.point = one.position + v.normal * (one.radius - 0.5 * v.overlap);
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

// Positions may have moved on since the forces. So some candidates may touch that have no contact yet.
template <class See>
void see_candidates(const ForceInput& in, std::size_t g, const ThreadContacts& contacts, ChunkMemory& memory,
                    const See& see) {
    const ContactGroup& group = in.rules.groups[g];
    const ContactTable& table = contacts.tables[g];
    Histories none;
    none.shape(group.history_size(), group.number_size());
    none.resize(kBlock);
    for (std::int32_t c = 0; c < table.candidates(); c += kChunk) {
        const Halo::Bodies bodies{table.near_first() + c, table.near_second() + c};
        std::uint64_t left = which_touch(in, group, bodies, std::min(kChunk, table.candidates() - c));
        for (left &= ~table.admitted(c); left != 0; left &= left - 1) {
            std::int32_t first[kBlock], second[kBlock];
            std::fill_n(first, kBlock, bodies.first[std::countr_zero(left)]);
            std::fill_n(second, kBlock, bodies.second[std::countr_zero(left)]);
            see_chunk(in, group, {first, second, first, second, 1}, none.of_block(0), contacts.begin, memory,
                      see);
        }
    }
}

}  // namespace

void view_contacts(const ForceInput& in, std::size_t g, const ThreadContacts& contacts,
                   const std::function<void(const ContactView&)>& in_order,
                   const std::function<void(const ContactView&)>& late) {
    ChunkMemory memory;
    const ContactTable& table = contacts.tables[g];
    table.each_chunk([&](std::int32_t c, int count) {
        const std::int32_t *const first = table.first() + c, *const second = table.second() + c;
        see_chunk(in, in.rules.groups[g], {first, second, first, second, count},
                  table.histories().of_block(c), contacts.begin, memory,
                  c < table.sorted() ? in_order : late);
    });
    see_candidates(in, g, contacts, memory, late);
}

}  // namespace grainreel
