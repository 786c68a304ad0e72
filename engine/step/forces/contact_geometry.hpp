// What touches how: geometry and motion of contacts, for the laws.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/law_kernel.hpp"
#include "engine/plan/plan.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/forces/walls.hpp"

namespace grainreel {

// What a law wants to know of the motion.
enum class Wants { overlap, velocity, spin, rolling };
inline Wants wants_of(const LawKernel& law) {
    return law.rubs ? Wants::spin : law.uses_velocity ? Wants::velocity : Wants::overlap;
}

struct GeometryInput {
    const Grains* grains;
    const std::int32_t *first, *second;  // of the chunk's contacts; of a wall contact: grain, face
    int count;                           // at most kChunk; rounded up to a multiple of kBlock all can be read
    Wants wants;
    LeverArms arms;
    double step;                        // s
    double turns_for;                   // s, twice as long as the velocities lie behind the positions
    RollingChunk* rolling;              // set when that is wanted
    bool mass = false, radius = false;  // effective ones are wanted
    bool rounded = false;               // rows are to hold floats; velocities are those of Grains::rounded
};

// A bit a contact, of at most kChunk of which whole registers can be read: are the surfaces closer than `gap`
// (m), or do they overlap where it is 0?
std::uint64_t near_pairs(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                         int count, double period, double gap);
std::uint64_t touching_walls(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const WallState& walls);

// period: m, of x; 0 for none.
void touch_pairs(const GeometryInput& in, double period, TouchChunk& out);
// Of what does not touch only the overlap need be set.
void touch_walls(const GeometryInput& in, const WallState& walls, TouchChunk& out);

}  // namespace grainreel
