// As inside_shares() of field_grid.hpp, of a vessel that is a mesh.
#pragma once

#include <vector>

#include "engine/measure/fields/field_grid.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

std::vector<double> shares_inside_mesh(const FieldGrid& grid, const Scene& scene);

}  // namespace grainreel
