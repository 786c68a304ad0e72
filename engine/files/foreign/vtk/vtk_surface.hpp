// The triangles of a cell of VTK: of surfaces, and of the faces of solid cells. Corners as in VTK: The VTK
// User's Guide, "VTK File Formats", figures of the linear cell types.
#pragma once

#include <array>
#include <vector>

#include "engine/files/foreign/vtk/vtk_piece.hpp"

namespace grainreel {

using VtkTriangle = std::array<std::int64_t, 3>;  // points of the piece

// Whether a cell is neither a point, a line nor empty.
bool is_surface(std::uint8_t type);

// Adds the triangles of a cell. Polygons are cut from their first corner, every second triangle of a strip is
// turned round. Throws UserError for cells that are no surface, or have too few corners.
void split_cell(const VtkPiece& piece, std::size_t cell, std::vector<VtkTriangle>& triangles);

}  // namespace grainreel
