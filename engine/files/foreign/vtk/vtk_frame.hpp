// What of a VTK data set is a grain, a contact or a wall. Points with vertex cells, or all points where there
// are no cells, are grains. Lines of two points are contacts. Triangles, polygons, strips and the faces of
// solid cells are walls.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_piece.hpp"

namespace grainreel {

// How much of everything there is, by the cells alone.
struct VtkCount {
    std::int64_t grains = 0, contacts = 0;
    bool walls = false;
    std::int64_t points_left_out = 0;  // without a cell, beside others that have vertex cells
    std::int64_t lines_left_out = 0;   // of one point, or of more than two
};

// Throws UserError for cells whose surface is not read.
VtkCount count_of(const std::vector<VtkPiece>& pieces);

// Throws UserError also where a piece has other columns than the one before it.
RawFrame frame_of(VtkContents&& contents);

// Adds what another file of the same moment holds. A column that only one of them has is NaN in the other's
// rows.
void merge_frames(RawFrame& frame, RawFrame&& more);

// A file of one frame, by the function that reads its kind. Throws UserError.
std::unique_ptr<RawFile> open_vtk_file(const std::filesystem::path& file,
                                       VtkContents (*read)(const std::filesystem::path& file, VtkPart part));

}  // namespace grainreel
