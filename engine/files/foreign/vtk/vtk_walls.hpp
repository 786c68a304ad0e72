// Makes walls of the surface cells of a VTK data set, by splitting each cell into triangles.
#pragma once

#include <array>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"

namespace grainreel {

// One wall with the cell data as its columns. For dumps of LIGGGHTS, which have an array "meshid", a wall for
// each mesh. Empty where there are no surface cells. Throws UserError for cells whose surface cannot be read.
std::vector<RawWall> walls_of(const VtkPiece& piece);

// The number of the mesh that each triangle belongs to, by the column "meshid". LIGGGHTS numbers the
// triangles of each mesh from 0, so a new mesh begins at each 0. Other programs may give all triangles of a
// mesh one number. All are 0 where it is neither.
std::vector<std::size_t> mesh_parts(const std::vector<double>& meshid);

// Adds the second wall to the first and returns true, if both have the same columns.
bool join_walls(RawWall& wall, const RawWall& more);

using VtkTriangle = std::array<std::int64_t, 3>;  // points of the piece

// Whether a cell is neither a point, a line nor empty.
bool is_surface(std::uint8_t type);

// Adds the triangles of a surface, or of the faces of a solid cell. The order of corners is VTK's (The VTK
// User's Guide, "VTK File Formats", figures of the linear cell types). Polygons are cut from their first
// corner; every second triangle of a strip is turned round. Throws UserError for cells that are no surface or
// have too few corners.
void split_cell(const VtkPiece& piece, std::size_t cell, std::vector<VtkTriangle>& triangles);

}  // namespace grainreel
