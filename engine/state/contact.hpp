// Contacts as plain values, away from laws and lists: who pushes whom, a contact as files keep it, and a
// force at a point.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/base/vector.hpp"

namespace grainreel {

// A contact of two bodies that push each other.
struct Link {
    std::int32_t first, second;  // ids; second is -1 - face for a wall
    double force;                // N, normal force
};

// A contact that carries force, as files keep it.
struct SavedContact {
    std::int32_t first, second;  // ids; second is -1 - wall for a wall: faces first, then meshes
    double normal;               // N, >= 0
    Vec3 tangential;             // N, on `second`
    Vec3 point;                  // m
    std::int32_t triangle = -1;  // triangle of a mesh that is touched; -1 for other bodies
    Vec3 rolling{0, 0, 0};       // N m, torque of the resistance to rolling on `second`
    bool operator==(const SavedContact&) const = default;
};

// A force on a body at the point where it acts.
struct PointForce {
    Vec3 at;                       // m
    Vec3 force;                    // N
    bool pulls = false;            // true if its arrow begins at the point, false if it ends there
    std::optional<Vec3> centre{};  // m, centre of the grain to which the force belongs
};

}  // namespace grainreel
