// A force on a body at the point where it acts.
#pragma once

#include <optional>

#include "engine/base/vector.hpp"

namespace grainreel {

struct PointForce {
    Vec3 at;                       // m
    Vec3 force;                    // N
    bool pulls = false;            // its arrow begins at the point; else it ends there
    std::optional<Vec3> centre{};  // m, of the grain that it is a force of
};

}  // namespace grainreel
