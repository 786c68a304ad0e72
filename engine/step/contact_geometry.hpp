// Vector code around the laws: what touches how, and from a law's answer to forces and torques on grains.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/law_kernel.hpp"
#include "engine/scene/plan.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/walls.hpp"

namespace grainreel {

// Force and torque of one contact: `force` acts on the second grain, its opposite on the first. The torque on
// either is -arm * turning, with turning = k x T. Without friction only `force` is set.
struct alignas(64) ContactForce {
    Vec3 force;         // N
    double first_arm;   // m, from the first grain's centre to where T acts
    Vec3 turning;       // N
    double second_arm;  // m
};
static_assert(sizeof(ContactForce) == 64, "one cache line a contact");

// What a law wants to know of the motion.
enum class Wants { overlap, velocity, spin };
inline Wants wants_of(const LawKernel& law) {
    return law.rubs ? Wants::spin : law.uses_velocity ? Wants::velocity : Wants::overlap;
}

struct GeometryInput {
    const Grains* grains;
    const std::int32_t *first, *second;  // of the chunk's contacts; of a wall contact: grain, face
    int count;                           // a multiple of kBlock, at most kChunk
    Wants wants;
    LeverArms arms;
    double step;  // s
};

// period: m, of x; 0 for none.
void touch_pairs(const GeometryInput& in, double period, TouchChunk& out);
void touch_walls(const GeometryInput& in, const WallState& walls, TouchChunk& out);

// Forces of the chunk's contacts, one behind the other.
void to_contact_forces(const TouchChunk& touch, const ForceChunk& force, int count, bool rubs,
                       ContactForce* out);

}  // namespace grainreel
