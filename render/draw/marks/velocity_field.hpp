// The grains' mean velocity in cells of the y-z plane, all along x.
#pragma once

#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct FieldCell {
    Vec3 middle{0, 0, 0};          // m, of the cell, moving with the walls
    Vec3 centre_of_mass{0, 0, 0};  // m, of its grains
    Vec3 velocity{0, 0, 0};        // m/s, mean weighted by mass: momentum over mass
    int grains = 0;
};

// m: side of a cell.
double field_cell_size(const Scene& scene);

// Cells with at least three grains. Velocities are of this moment or, when the scene asks for a period,
// displacements over it; no cells then as long as the frame has none. A grain belongs to the cell that its
// centre is in.
std::vector<FieldCell> velocity_field(const Scene& scene, const Frame& frame);

}  // namespace grainreel
