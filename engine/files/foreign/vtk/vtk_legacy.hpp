// Legacy files of VTK (.vtk), text and binary, versions 1 to 5.1: PolyData and UnstructuredGrid.
#pragma once

#include <filesystem>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"

namespace grainreel {

RawFormat vtk_legacy_format();

// Throws UserError with file and line (text) or byte (binary): damage, grids, cells whose surface is not
// read.
VtkContents read_vtk_legacy(const std::filesystem::path& file, VtkPart part);

bool takes_vtk_legacy(const FileHead& head);

}  // namespace grainreel
