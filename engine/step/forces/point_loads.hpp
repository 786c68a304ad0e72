// Adds the forces of walls whose points move in different ways: of meshes, and of faces where one turns.
#pragma once

#include "engine/step/forces/loads.hpp"

namespace grainreel {

// As add_walls(). The contacts' second bodies are faces, or patches of meshes.
void add_at_points(const WallForces& forces, bool of_meshes);
// Adds the load of contact c alone, which must touch.
void add_at_point(const WallForces& forces, bool of_meshes, int c);
// As add_at_points() for patches of meshes, a register at a time and with the same bits.
void add_at_meshes(const WallForces& forces);

}  // namespace grainreel
