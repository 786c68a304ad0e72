// Reads the files of one moment, which a collection or a .vtm names: VTK files of any kind, and surfaces
// without grains (STL, OBJ, PLY).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/xml_tree.hpp"

namespace grainreel {

// A file and the name of what it holds, which is mostly a mesh.
struct VtkPartFile {
    std::filesystem::path file;
    std::string name;
    bool operator==(const VtkPartFile&) const = default;
};

// What was found in the files of one moment.
struct VtkParts {
    RawMoment moment;            // counts, for VtkPart::cells
    RawFrame frame;              // for VtkPart::all
    std::string program;         // the program that wrote them, if they say so
    std::size_t grids = 0;       // number of files with grids that were left out
    std::filesystem::path grid;  // the first of them
    std::size_t missing = 0;     // number of files that a .vtm names and that do not exist
};

// Adds what a file holds: VTK XML, legacy VTK, .vtm, or a surface. Grids are left out, except for a block
// with the name "Domain", which is the box. Throws UserError.
void add_part(const VtkPartFile& part_file, VtkPart part, VtkParts& parts, int depth = 0);

// The files that a .vtm names, with the names of their blocks.
std::vector<VtkPartFile> files_of_blocks(const std::filesystem::path& file, const XmlTree& tree);

bool is_block_type(std::string_view type);

// Surfaces without grains: STL (text and binary), OBJ and PLY. They are one frame, with a wall for each solid
// of an STL.
RawFormat wall_surface_format();

bool takes_wall_surface(const FileStart& head);

// Reads the walls in the file's unit, without mending them. Throws UserError with file and line or byte.
std::vector<RawWall> read_wall_surface(const std::filesystem::path& file);

}  // namespace grainreel
