// From a law's answer to forces and torques on grains.
#pragma once

#include <cstdint>

#include "engine/laws/touch_chunk.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/forces/walls.hpp"

namespace grainreel {

// A chunk's contacts.
struct ChunkOfContacts {
    const std::int32_t *first, *second;  // of a wall contact: grain, face
    int count;
    const TouchChunk* touch;
    const ForceChunk* force;
    bool rubs;
    const RollingChunk* rolling;  // nullptr where rolling meets no resistance
    bool rounded;                 // rows hold floats
    bool sorted = false;          // by rising first body, which is lower than the second
};

// Adds them to the loads of their grains: each grain's one after the other, in the contacts' order.
void add_pairs(const ChunkOfContacts& chunk, Grains& grains);
// Contacts with walls.
struct WallForces {
    const ChunkOfContacts& contacts;
    const WallState& walls;
    double step;  // s, that the forces act
    Grains& grains;
};

// Adds them to the grains' loads, and what walls do as they move to the work.
void add_walls(const WallForces& forces);

}  // namespace grainreel
