// The outermost points that meshes come to in the course of a run.
#pragma once

#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m: of all meshes together, the farthest points along many directions, at rest and wherever their turns and
// paths bring them. Steady velocities, which have no end, and the drive are left out. Empty without meshes.
std::vector<Vec3> mesh_reach(const FilmedScene& scene);

}  // namespace grainreel
