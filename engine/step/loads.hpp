// From a law's answer to forces and torques on grains.
#pragma once

#include <cstdint>

#include "engine/laws/touch_chunk.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/walls.hpp"

namespace grainreel {

// What the contacts of a chunk do to their two bodies. Without friction only forces are set.
struct LoadChunk {
    struct Contact {
        Load on_first, on_second;
    };
    Contact contact[kChunk];
    Load of_others;  // what goes to grains of other threads, which nobody reads
};

// A chunk's contacts; all of them touch.
struct ChunkOfContacts {
    const std::int32_t *first, *second;  // of a wall contact: grain, face
    int count;
    const TouchChunk* touch;
    const ForceChunk* force;
    bool rubs;
    const RollingChunk* rolling;  // nullptr where rolling meets no resistance
};

// Adds them to the loads of those of their grains that lie in [begin, end).
void add_pairs(const ChunkOfContacts& chunk, LoadChunk& scratch, std::int32_t begin, std::int32_t end,
               Grains& grains);
// Of grains and walls: to the grains' loads, and what moving walls do to the work.
void add_walls(const ChunkOfContacts& chunk, LoadChunk& scratch, const WallState& walls, double step,
               Grains& grains);

}  // namespace grainreel
