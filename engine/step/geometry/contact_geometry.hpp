// Geometry and motion of contacts: from the places and motions of the bodies to the rows that a law reads
// (TouchChunk, engine/laws/law_kernel.hpp). The formulas are in *_formulas-inl.hpp, for one number or a
// register.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/laws/law_kernel.hpp"
#include "engine/plan/plan.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/geometry/walls.hpp"

namespace grainreel {

// Which parts of the motion a law reads. Each value includes the values before it.
enum class Wants { overlap, velocity, spin, rolling };
inline Wants wants_of(const LawKernel& law) {
    return law.rubs ? Wants::spin : law.uses_velocity ? Wants::velocity : Wants::overlap;
}

// The place and the motion of a grain as bundles of four doubles: how many doubles they have, and with which
// one the spin begins.
inline constexpr int kPlaceNumbers = sizeof(Place) / sizeof(double),
                     kMotionNumbers = sizeof(Motion) / sizeof(double),
                     kSpinOfMotion = offsetof(Motion, spin) / sizeof(double);

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

// Returns one bit for each pair, which says whether the surfaces are closer than `gap` (m). A gap of 0 asks
// whether they overlap. There are at most kChunk pairs, and the arrays can be read up to a multiple of
// kBlock.
// `period` is the period of x in m, or 0.
std::uint64_t near_pairs(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                         int count, double period, double gap);
// Returns one bit for each grain and face, which says whether they overlap.
std::uint64_t touching_walls(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const WallState& walls);

// These functions fill the rows that `in` asks for. Contacts that do not touch need only their overlap set.
void touch_pairs(const GeometryInput& in, double period, TouchChunk& out);
void touch_walls(const GeometryInput& in, const WallState& walls, TouchChunk& out);

// Contacts of grains with grains that are glued to walls. The kernels of pairs and of walls know nothing of
// them.

// Glued grains, and the state of the walls that carry them. `period` is the period of x in m, or 0.
struct GluedState {
    const GluedGrains& glued;
    const WallState& walls;
    double period;
};

// Finds the faces of `count` glued grains and of the copies that fill their last block.
void find_faces(const GluedGrains& glued, const std::int32_t* second, int count, std::int32_t* face);

// Do what touching_walls() and touch_walls() do, for glued grains. `second` holds numbers of glued grains,
// and `face` the result of find_faces().
std::uint64_t touching_glued(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const GluedState& state);
void touch_glued(const GeometryInput& in, const GluedState& state, const std::int32_t* face, TouchChunk& out);

// Contacts with walls of which some end at edges, for example the walls of a container with an open outlet.
// In scenes without such walls, touch_walls() in wall_geometry.cpp does the work; it calls these functions if
// any wall ends.

// Do what touching_walls() and touch_walls() do, for walls that end.
std::uint64_t touching_plates(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                              int count, const WallState& walls);
void touch_plates(const GeometryInput& in, const WallState& walls, TouchChunk& out);

}  // namespace grainreel
