// Adds the forces and torques that a law has computed to the loads of the grains.
#pragma once

#include <cstdint>

#include "engine/laws/law_kernel.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/geometry/walls.hpp"

namespace grainreel {

// The contacts of a chunk.
struct ChunkOfContacts {
    const std::int32_t *first, *second;  // the two bodies; at a wall: grain and face
    int count;
    const TouchChunk* touch;
    const ForceChunk* force;
    bool rubs;
    const RollingChunk* rolling;  // nullptr: no resistance to rolling
    bool rounded;                 // rows hold floats
    bool sorted = false;    // by rising first body, each of which has a lower index than its second body
    bool of_glued = false;  // contacts with glued grains; `second` is the face that carries them
};

// Adds the forces of pairs to the loads of their grains. Each grain sums its forces in the contacts' order.
void add_pairs(const ChunkOfContacts& chunk, Grains& grains);

struct WallLoads {
    const ChunkOfContacts& contacts;
    const WallState& walls;
    double step;  // s, how long the forces act
    Grains& grains;
};

// Adds the forces of walls to the grains' loads, and the work of moving walls to Grains::wall_work.
void add_walls(const WallLoads& forces);

// Does what add_walls() does, for walls whose points move in different ways: meshes, and faces where one of
// them turns. The contacts' second bodies are faces, or patches of meshes.
void add_at_points(const WallLoads& forces, bool of_meshes);
// Adds the load of contact c alone, which must touch.
void add_at_point(const WallLoads& forces, bool of_meshes, int c);
// Does what add_at_points() does for patches of meshes, a register at a time and with the same bits.
void add_at_meshes(const WallLoads& forces);

}  // namespace grainreel
