#include "engine/step/forces/contact_forces.hpp"

#include <algorithm>
#include <cstddef>

#include "engine/step/forces/loads.hpp"
#include "engine/step/forces/mesh_contacts.hpp"
#include "engine/step/forces/new_contacts.hpp"
#include "engine/step/forces/point_loads.hpp"
#include "engine/step/lists/large_bed.hpp"

namespace grainreel {

namespace {

// Adds the forces in `memory` to the loads of the chunk's grains.
void add_loads(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, bool rounded, bool sorted,
               const ChunkMemory& memory, Grains& grains) {
    const ChunkOfContacts forces{chunk.first_at,
                                 group.of_glued ? memory.face : chunk.second_at,
                                 chunk.count,
                                 &memory.touch,
                                 &memory.force,
                                 group.law->rubs,
                                 group.rolling ? &memory.rolling : nullptr,
                                 rounded,
                                 sorted};
    if (group.of_pairs) return add_pairs(forces, grains);
    const WallForces at_walls{forces, in.walls, in.times.acts, grains};
    if (group.of_mesh) return add_at_meshes(at_walls);
    in.walls.turning && !group.of_glued ? add_at_points(at_walls, false) : add_walls(at_walls);
}

}  // namespace

// Contacts go through geometry, law and loads a chunk at a time, so that a chunk stays in the cache. Those at
// walls come before those of pairs, and of one law those that began since the last refresh come first.
void add_contact_forces(const ForceInput& in, Grains& grains, ThreadContacts& contacts, ChunkMemory& memory,
                        Vanguard& vanguard, CostClock& clock) {
    for (std::size_t g = contacts.tables.size(); g-- > 0;) {
        const ContactGroup& group = in.rules.groups[g];
        const bool rounded = group.number_size() == sizeof(float);
        ContactTable& table = contacts.tables[g];
        group.of_mesh ? find_patches(in, g, contacts, memory.matcher) : add_new_contacts(in, g, contacts);
        table.each_chunk([&](std::int32_t c, int count) {
            const bool sorted = c < table.sorted(), large = group.of_pairs && sorted && is_large_bed(grains);
            memory.touch.ahead = large ? &memory.ahead : nullptr;
            if (large) look_ahead(grains, rounded, table, c, count, memory.ahead);
            const auto [first, second] = contacts.bodies_of(in.rules, g, c, count);
            const MeshTouch* const mesh = group.of_mesh ? contacts.meshes[g].touch.data() + c : nullptr;
            const Chunk chunk{table.first() + c, table.second() + c, first, second, count, mesh};

            const LawInput law = law_input(in, group, chunk, rounded, memory);
            table.note_touching(c, memory.touch.touching);
            // From here to the formula: step_chunk() loads a register of contacts and ContactLaw::force()
            // joins the two laws (both in engine/laws/contact_law-inl.hpp). Their force() is the formula:
            // SpringDashpot::force() (spring_dashpot-inl.hpp), LinearSpring::force() (linear_spring-inl.hpp)
            // and so on.
            const auto step = are_of_one_kind(group, law) ? group.law->step_one_kind : group.law->step;
            void* history = table.histories().of_block(c);
            step(law, history, memory.force);
            if (group.rolling)
                group.rolling->step(for_rolling(group, law), behind_law(group, history), memory.force);
            if (group.of_mesh) remember_patches(group, mesh, memory, c, count, table.histories());
            clock.lap(group.of_pairs ? Cost::contacts : Cost::walls);

            add_loads(in, group, chunk, rounded, sorted, memory, grains);
            clock.lap(group.of_pairs ? Cost::gather : Cost::walls);

            // The sorted contacts of the first group come last. Grains before the next contact have all
            // their forces.
            if (g != 0 || !sorted || c + count == table.sorted()) return;
            advance(vanguard, grains, table.first()[c + count]);
            clock.lap(Cost::integrate);
        });
    }
    advance(vanguard, grains, contacts.end);
    clock.lap(Cost::integrate);
}

}  // namespace grainreel
