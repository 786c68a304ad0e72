// Where what the drive moves is.
#pragma once

#include "engine/base/vector.hpp"

namespace grainreel {

// Its displacement from rest and its velocity, both at the same time level.
struct Pose {
    Vec3 offset{0, 0, 0};    // m
    Vec3 velocity{0, 0, 0};  // m/s
    double time = 0;         // s, since the start of the motion
};

}  // namespace grainreel
