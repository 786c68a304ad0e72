// What several files hold at one moment: those that a collection names, and those within a .vtm.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/xml_tree.hpp"

namespace grainreel {

// A file, and the name of what it holds: of a mesh, as a rule.
struct VtkPartFile {
    std::filesystem::path file;
    std::string name;
    bool operator==(const VtkPartFile&) const = default;
};

// What was found in the files of one moment.
struct VtkParts {
    RawMoment moment;            // counts, for VtkPart::cells
    RawFrame frame;              // for VtkPart::all
    std::string program;         // that wrote them, where they say so
    std::size_t grids = 0;       // files of grids that were passed over
    std::filesystem::path grid;  // the first of them
    std::size_t missing = 0;     // files that a .vtm names and that are not there
};

// Adds what a file holds: VTK XML, legacy VTK, .vtm, or a surface. Grids are passed over, but for a block of
// the name "Domain", which is the box. Throws UserError.
void add_part(const VtkPartFile& part_file, VtkPart part, VtkParts& parts, int depth = 0);

// The files that a .vtm names, with the names of their blocks.
std::vector<VtkPartFile> files_of_blocks(const std::filesystem::path& file, const XmlTree& tree);

bool is_block_type(std::string_view type);

// Surfaces without grains: STL (text and binary), OBJ and PLY. One frame, with a wall for each solid of an
// STL.

RawFormat wall_surface_format();

bool takes_wall_surface(const FileHead& head);

// In the file's unit, as it is: nothing is mended. Throws UserError with file and line or byte.
std::vector<RawWall> read_wall_surface(const std::filesystem::path& file);

}  // namespace grainreel
