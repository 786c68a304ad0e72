// Walls out of the surface cells of a VTK data set.
#pragma once

#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_piece.hpp"

namespace grainreel {

// One wall with the cell data as its columns; of LIGGGHTS' dumps, which have an array "meshid", one for each
// mesh. Empty where there are no surface cells. Throws UserError for cells whose surface is not read.
std::vector<RawWall> walls_of(const VtkPiece& piece);

// Which part of the cells each triangle belongs to, by the column "meshid". LIGGGHTS numbers the triangles of
// each mesh from 0, one mesh after the other, so a part begins at each 0; other programs may give all
// triangles of a mesh one number. All 0 where it is neither.
std::vector<std::size_t> mesh_parts(const std::vector<double>& meshid);

// Adds the second to the first, and returns true, where both have the same columns.
bool join_walls(RawWall& wall, const RawWall& more);

}  // namespace grainreel
