// Vec3, the vector type of the whole program: three doubles, z up.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace grainreel {

using Vec3 = Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;

}  // namespace grainreel
