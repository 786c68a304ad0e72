// From a chunk of contacts to what its law reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "engine/laws/law_kernel.hpp"
#include "engine/step/forces/force_input.hpp"
#include "engine/step/forces/match_patches.hpp"

namespace grainreel {

// Some contacts, at most kChunk, that stand side by side in arrays.
struct Chunk {
    const std::int32_t *first, *second;        // the two bodies; at a wall: grain and face
    const std::int32_t *first_at, *second_at;  // where to read them; of other threads' grains: the copies
    int count;
    const MeshTouch* mesh = nullptr;  // of contacts with meshes: where they touch
};

// Memory for a chunk on its way through geometry, law and loads.
struct ChunkMemory {
    TouchChunk touch;
    ForceChunk force;
    RollingChunk rolling;
    std::int32_t kind[kChunk] = {};  // of the chunk's contacts, where there are several
    std::int32_t face[kChunk] = {};  // of glued grains: on which they stand
    Ahead ahead;
    PatchMatcher matcher;
};

// Computes the geometry of the chunk into memory.touch, in floats if `rounded`. Returns the input of its law.
LawInput law_input(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, bool rounded,
                   ChunkMemory& memory);

// Whether all contacts of a chunk have the same parameters.
inline bool are_of_one_kind(const ContactGroup& group, const LawInput& in) {
    if (!group.needs_rows()) return true;
    std::int32_t others = 0;
    for (int c = 0; c < in.count; ++c) others |= in.kind[c] ^ in.kind[0];
    return others == 0;
}

// Resistance to rolling is the second law of a chunk. In each block of the history its numbers stand behind
// those of the first law.
inline LawInput for_rolling(const ContactGroup& group, LawInput in) {
    in.parameters = &group.rolling_parameters;
    return in;
}
template <class History>
History* behind_law(const ContactGroup& group, History* history) {
    using Byte = std::conditional_t<std::is_const_v<History>, const std::byte, std::byte>;
    return static_cast<Byte*>(history) + kBlock * group.number_size() * group.law->history_size;
}

}  // namespace grainreel
