// What VTK's formats show of a frame: its grains as points, its walls as triangles. The lines of contacts are
// in vtk_file.hpp. Arrays have the names that other programs read: id, type (from 1, as in LAMMPS), omega.
#pragma once

#include <optional>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/files/frames/writers/vtk_file.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

VtkPolyData vtk_grains(const State& frame, const StoredWorld& world, const StateSupply& supply);

// The forces of forces_on_grains() as an array; NaN where none are known.
VtkList vtk_forces(const State& frame, const std::optional<std::vector<Vec3>>& forces);

// The surfaces in their places at that moment. "wall" is the number of a triangle's surface.
VtkPolyData vtk_walls(const std::vector<WorldSurface>& surfaces, const State& frame);

}  // namespace grainreel
