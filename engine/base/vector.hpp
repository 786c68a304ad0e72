// Vec3 and Quaternion, the types of all vectors and rotations in the program. z points up.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace grainreel {

using Vec3 = Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;

}  // namespace grainreel
