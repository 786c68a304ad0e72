// Velocity Verlet (Swope et al. 1982): half a kick and a drift before the forces, half a kick after them.
#pragma once

#include <cstdint>

#include "engine/state/grains.hpp"

namespace grainreel {

struct KickInput {
    Vec3 gravity;     // m/s2
    double step;      // s
    bool rubs;        // spins follow torques
    Vec3 frame;       // m/s, velocity against which speeds are measured
    double keep = 1;  // share of velocity and spin that drag leaves
};

// First half for the grains [begin, end): v and w to the middle of the step, x to its end; loads are used up
// and set to zero. Returns the largest components (m/s) of their velocities against the frame.
Vec3 kick_and_drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Second half: v and w to the end of the step. Loads stay.
void kick(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// The second half of a step and the first of the next at once, the same bits as one after the other.
Vec3 kick_and_go_on(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

}  // namespace grainreel
