/// @file
/// Vectors and rotations as plain numbers. They have no arithmetic of their own: copy the numbers, and use
/// Eigen or code of your own.
#pragma once

#include "grainreel/version.hpp"

namespace grainreel::v1 {

/// Three numbers along x, y and z. x runs along a hopper's depth, y across its width, z up; the origin is the
/// middle of the floor at rest.
struct Vector {
    double x = 0;  ///< Along the depth.
    double y = 0;  ///< Across the width.
    double z = 0;  ///< Up.
};

/// A rotation as a quaternion of length 1: w + x i + y j + z k.
struct Rotation {
    double w = 1;  ///< cos(angle / 2)
    double x = 0;  ///< x of the axis, times sin(angle / 2)
    double y = 0;  ///< y of the axis, times sin(angle / 2)
    double z = 0;  ///< z of the axis, times sin(angle / 2)
};

}  // namespace grainreel::v1
