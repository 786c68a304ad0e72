#include "engine/step/forces/law_input.hpp"

#include <algorithm>

#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/geometry/wall_point.hpp"

namespace grainreel {

namespace {

// The kind of each contact of a chunk, and of the copies that fill it.
const std::int32_t* kinds_of(const ForceInput& in, const ContactGroup& group, const Chunk& chunk,
                             std::int32_t* kind) {
    static constexpr std::int32_t kOne[kChunk] = {};
    if (!group.needs_rows()) return kOne;
    const auto& species = in.grains.species;
    for (int c = 0; c < chunk.count; ++c) {
        const std::int32_t one = species[chunk.first[c]];
        kind[c] = group.row[group.of_pairs ? one * in.rules.species + species[chunk.second[c]] : one];
    }
    for (int c = 0; group.of_mesh && c < chunk.count; ++c)
        kind[c] = group.row[mesh_of(chunk.second[c]) * in.rules.species + species[chunk.first[c]]];
    std::fill_n(kind + chunk.count, kChunk - chunk.count, 0);
    return kind;
}

// The geometry of each contact.
void touch(const ForceInput& in, const ContactGroup& group, const GeometryInput& geometry,
           const MeshTouch* mesh, ChunkMemory& memory) {
    if (group.of_pairs) return touch_pairs(geometry, in.rules.period, memory.touch);
    if (group.of_mesh) return touch_meshes(geometry, mesh, memory.touch);
    if (!group.of_glued) return touch_walls(geometry, in.walls, memory.touch);
    find_faces(in.glued, geometry.second, geometry.count, memory.face);
    touch_glued(geometry, {in.glued, in.walls, in.rules.period}, memory.face, memory.touch);
}

}  // namespace

LawInput law_input(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, bool rounded,
                   ChunkMemory& memory) {
    const GeometryInput geometry{&in.grains,
                                 chunk.first_at,
                                 chunk.second_at,
                                 chunk.count,
                                 group.rolling ? Wants::rolling : wants_of(*group.law),
                                 in.rules.arms,
                                 in.times.since,
                                 group.law->at_mid_step ? in.times.turns : 0,
                                 &memory.rolling,
                                 group.law->uses_mass,
                                 group.law->uses_radius || group.rolling,
                                 rounded};
    touch(in, group, geometry, chunk.mesh, memory);
    memory.touch.touching &= bits_of_first(chunk.count);  // without the copies that fill the last block
    return {chunk.count,          &memory.touch,  kinds_of(in, group, chunk, memory.kind),
            &group.parameters,    in.times.since, in.times.ahead,
            group.history_size(), &memory.rolling};
}

}  // namespace grainreel
