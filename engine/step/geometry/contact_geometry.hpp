// Geometry and motion of contacts: from the places and motions of the bodies to the rows that a law reads
// (TouchChunk, engine/laws/touch_chunk.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/law_kernel.hpp"
#include "engine/plan/plan.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/geometry/walls.hpp"

namespace grainreel {

// What a law reads of the motion. Each word includes those before it.
enum class Wants { overlap, velocity, spin, rolling };
inline Wants wants_of(const LawKernel& law) {
    return law.rubs ? Wants::spin : law.uses_velocity ? Wants::velocity : Wants::overlap;
}

struct GeometryInput {
    const Grains* grains;
    const std::int32_t *first, *second;  // the two bodies of each contact; at a wall: grain and face
    int count;                           // at most kChunk; the arrays can be read up to a multiple of kBlock
    Wants wants;
    LeverArms arms;
    double step;                        // s
    double turns_for;                   // s, twice the time by which velocities lag behind positions
    RollingChunk* rolling;              // filled where `wants` is Wants::rolling
    bool mass = false, radius = false;  // whether the law reads the effective mass, the effective radius
    bool rounded = false;               // rows hold floats, and velocities come from Grains::rounded
};

// One bit for each pair: whether the surfaces are closer than `gap` (m). With a gap of 0: whether they
// overlap. There are at most kChunk pairs, and the arrays can be read up to a multiple of kBlock.
// period: of x, in m; 0 for none.
std::uint64_t near_pairs(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                         int count, double period, double gap);
// One bit for each grain and face: whether they overlap.
std::uint64_t touching_walls(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const WallState& walls);

// Fill the rows that `in` asks for. Of contacts that do not touch, only the overlap need be set.
void touch_pairs(const GeometryInput& in, double period, TouchChunk& out);
void touch_walls(const GeometryInput& in, const WallState& walls, TouchChunk& out);

// Contacts of grains with grains that are glued to walls. Scenes without glued grains have no such contacts,
// and the kernels of pairs and of walls know nothing of them.

// Glued grains where their walls are. period: of x, in m; 0 for none.
struct GluedState {
    const GluedGrains& glued;
    const WallState& walls;
    double period;
};

// The face of each of `count` glued grains, and of those that fill their last block.
void find_faces(const GluedGrains& glued, const std::int32_t* second, int count, std::int32_t* face);

// As touching_walls() and touch_walls(); `second` are numbers of glued grains, and `face` what find_faces()
// gives.
std::uint64_t touching_glued(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const GluedState& state);
void touch_glued(const GeometryInput& in, const GluedState& state, const std::int32_t* face, TouchChunk& out);

// Contacts with walls of which some end at edges, as those of a container with an open outlet do. Scenes
// without such walls take the way of touch_walls() in wall_geometry.cpp, which calls these where they are
// needed.

// As touching_walls() and touch_walls().
std::uint64_t touching_plates(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                              int count, const WallState& walls);
void touch_plates(const GeometryInput& in, const WallState& walls, TouchChunk& out);

}  // namespace grainreel
