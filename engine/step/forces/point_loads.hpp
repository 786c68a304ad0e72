// Adds the forces of walls whose points move in different ways: of meshes, and of faces where one turns.
#pragma once

#include "engine/step/forces/loads.hpp"

namespace grainreel {

// As add_walls(). The contacts' second bodies are faces, or patches of meshes.
void add_at_points(const WallForces& forces, bool of_meshes);

}  // namespace grainreel
