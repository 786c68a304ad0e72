// A contact as one who asks what pushes a grain wants to know it.
#pragma once

#include <cstdint>

#include "engine/base/vector.hpp"

namespace grainreel {

struct ContactForce {
    std::int32_t first, second;  // ids; second is -1 - face for a wall
    Vec3 normal;                 // unit, from first to second
    double overlap;              // m
    double normal_force;         // N, on second along the normal; below 0 where the law attracts
    Vec3 tangential;             // N, on second
    Vec3 torque_on_first;        // N m
    Vec3 torque_on_second;       // N m; zero for a wall
    double friction;             // coefficient of this pair
    Vec3 point;                  // m
    double smaller_radius;       // m, of the two; of a wall that of the grain
    double stored_energy;        // J, that unloading would give back
    std::int32_t triangle = -1;  // of a mesh: where it is touched

    Vec3 on_second() const { return normal_force * normal + tangential; }  // N
    Vec3 on_first() const { return -on_second(); }
    // Bodies may also touch without a force: springs that are latched, and grains that part.
    bool pushes() const { return normal_force != 0 || !tangential.isZero(0); }
    // Whether friction is all used up, so that the surfaces slide.
    bool slides() const {
        constexpr double all = 1 - 1e-6;
        return friction > 0 && normal_force > 0 && tangential.norm() >= all * friction * normal_force;
    }
};

}  // namespace grainreel
