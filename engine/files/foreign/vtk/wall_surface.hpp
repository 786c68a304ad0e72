// Surfaces without grains: STL (text and binary), OBJ and PLY. One frame, with a wall for each solid of an
// STL.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

RawFormat wall_surface_format();

bool takes_wall_surface(const FileHead& head);

// In the file's unit, as it is: nothing is mended. Throws UserError with file and line or byte.
std::vector<RawWall> read_wall_surface(const std::filesystem::path& file);

}  // namespace grainreel
