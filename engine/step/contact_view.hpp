// One touching contact as an observer sees it.
#pragma once

#include <cstdint>

#include "engine/base/vector.hpp"

namespace grainreel {

struct ContactView {
    std::int32_t first;      // index of a grain
    std::int32_t second;     // index of a grain, or -1 - face; meshes are numbered after the faces
    std::int32_t glued;      // number of a glued grain on that face; -1 for the face itself and for a grain
    std::int32_t triangle;   // triangle of a mesh that is touched; -1 for all other bodies
    Vec3 normal;             // unit, from first to second
    double overlap;          // m
    double smaller_radius;   // m
    double normal_force;     // N
    Vec3 tangential;         // N, on second
    Vec3 torque_on_first;    // N m
    Vec3 rolling;            // N m, torque of the resistance to rolling on second; 0 without
    Vec3 torque_on_second;   // N m; not set for a wall
    double stored_energy;    // J, energy that unloading would give back
    double sideways_energy;  // J, the part of it in tangential and rolling springs
    double latched_energy;   // J, energy lost in the latching spring since the bodies met, if they were
                             // unloaded now
    double damping_power;    // W, lost in the normal dashpot
    double rubbing_power;    // W, that slip and rolling put into springs, friction and tangential dashpots
    Vec3 point;              // m, where the bodies touch: on a wall's surface, or where two spheres intersect
};

}  // namespace grainreel
