// A contact that carries force, as files keep it.
#pragma once

#include <cstdint>

#include "engine/base/vector.hpp"

namespace grainreel {

struct ContactRecord {
    std::int32_t first, second;  // ids; second is -1 - wall for a wall: faces first, then meshes
    double normal;               // N, >= 0
    Vec3 tangential;             // N, on `second`
    Vec3 point;                  // m
    std::int32_t triangle = -1;  // of a mesh: where it is touched
    bool operator==(const ContactRecord&) const = default;
};

}  // namespace grainreel
