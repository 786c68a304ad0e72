// Which sides of a mesh look into something that it encloses, and which look out.
#pragma once

#include <vector>

#include "render/picture/mesh/mesh_shape.hpp"

namespace grainreel {

// The sides of each triangle. A side is told by how much of what is around it is surface again: a few rays
// from each patch say so.
std::vector<MeshShape::Sides> find_sides(const Surface& surface, double edge_angle, MeshLook look);

}  // namespace grainreel
