#include "engine/files/foreign/vtk/vtk_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/vtk_legacy.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"
#include "engine/files/foreign/vtk/vtk_xml.hpp"
#include "engine/files/foreign/vtk/wall_surface.hpp"
#include "engine/files/foreign/vtk/xml_arrays.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr int most_depth = 4;  // of lists within lists
constexpr std::string_view domain_name = "Domain";

// LIGGGHTS writes its box as a rectilinear grid of one cell, and a tilted one as a hexahedron.
std::optional<WorldCell> box_of_grid(const fs::path& file, const std::string& bytes, const XmlTree& tree) {
    const XmlElement* grid = tree.root.child("RectilinearGrid");
    const XmlElement* piece = grid == nullptr ? nullptr : grid->child("Piece");
    const XmlElement* axes = piece == nullptr ? nullptr : piece->child("Coordinates");
    if (axes == nullptr || axes->children.size() != 3) return std::nullopt;
    const XmlArrays arrays(file, bytes, tree);
    WorldCell box;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<double> values = arrays.numbers(axes->children[k], std::nullopt, true);
        if (values.empty()) return std::nullopt;
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const auto axis = static_cast<Eigen::Index>(k);
        box.origin[axis] = *low;
        box.edges[k][axis] = *high - *low;
    }
    return box;
}

std::optional<WorldCell> box_of_cell(const fs::path& file) {
    const VtkContents contents = read_vtk_xml(file, VtkPart::all);
    if (contents.pieces.size() != 1) return std::nullopt;
    const VtkPiece& piece = contents.pieces[0];
    if (piece.cells.size() != 1 || piece.cells.types[0] != VtkCell::hexahedron ||
        piece.cells.corners.size() != 8)
        return std::nullopt;
    const auto place = [&](std::size_t corner) {
        const double* from = piece.places.data() + 3 * static_cast<std::size_t>(piece.cells.corners[corner]);
        return Vec3(from[0], from[1], from[2]);
    };
    WorldCell box;
    box.origin = place(0);
    box.edges = {place(1) - box.origin, place(3) - box.origin, place(4) - box.origin};
    return box;
}

bool is_grid(std::string_view type) {
    return type.ends_with("Grid") ? !type.ends_with("UnstructuredGrid") : type.ends_with("ImageData");
}

void add_domain(const fs::path& file, const std::string& type, VtkParts& parts) {
    std::optional<WorldCell> box;
    if (type == "UnstructuredGrid") box = box_of_cell(file);
    if (type == "RectilinearGrid") {
        const std::string bytes = all_bytes(file);
        box = box_of_grid(file, bytes, xml_tree(file, bytes));
    }
    if (!box) return;
    parts.frame.box = box;
    parts.program = "LIGGGHTS";
}

void add_contents(VtkContents&& contents, const std::string& name, VtkPart part, VtkParts& parts) {
    if (!contents.program.empty()) parts.program = contents.program;
    RawMoment& moment = parts.moment;
    if (!moment.time) moment.time = contents.time;
    if (!moment.step) moment.step = contents.step;
    if (part == VtkPart::cells) {
        const VtkCount count = count_of(contents.pieces);
        moment.grains += count.grains;
        moment.has_contacts = moment.has_contacts || count.contacts > 0;
        moment.has_walls = moment.has_walls || count.walls;
        return;
    }
    RawFrame frame = frame_of(std::move(contents));
    for (RawWall& wall : frame.walls)
        if (wall.name.empty()) wall.name = name;
    merge_frames(parts.frame, std::move(frame));
}

void add_surface(const fs::path& file, const std::string& name, VtkPart part, VtkParts& parts) {
    parts.moment.has_walls = true;
    if (part == VtkPart::cells) return;
    RawFrame frame;
    frame.walls = read_wall_surface(file);
    for (RawWall& wall : frame.walls)
        if (wall.name.empty()) wall.name = name;
    merge_frames(parts.frame, std::move(frame));
}

void add_blocks(const fs::path& file, VtkPart part, VtkParts& parts, int depth) {
    if (depth >= most_depth)
        refuse_vtk_file(file, "lists of files within lists without an end; name the files themselves");
    for (const VtkPartFile& block : files_of_blocks(file, xml_tree(file, all_bytes(file)))) {
        if (is_plain(block.file))
            add_part(block, part, parts, depth + 1);
        else
            ++parts.missing;
    }
}

void find_files(const fs::path& folder, const XmlElement& element, const std::string& block,
                std::vector<VtkPartFile>& files) {
    for (const XmlElement& child : element.children) {
        const std::string own(child.attribute("name"));
        const std::string& name = own.empty() ? block : own;
        if (child.name == "DataSet" && child.has("file"))
            files.push_back({folder / named_file(folder, child.attribute("file")), name});
        else
            find_files(folder, child, name, files);
    }
}

}  // namespace

bool is_block_type(std::string_view type) {
    return type == "vtkMultiBlockDataSet" || type == "vtkPartitionedDataSetCollection" ||
           type == "vtkPartitionedDataSet";
}

std::vector<VtkPartFile> files_of_blocks(const fs::path& file, const XmlTree& tree) {
    std::vector<VtkPartFile> files;
    find_files(file.parent_path(), tree.root, "", files);
    return files;
}

void add_part(const VtkPartFile& part_file, VtkPart part, VtkParts& parts, int depth) {
    const fs::path& file = part_file.file;
    const FileHead head = unpacked_head(file);
    const std::string type = vtk_file_type(head.bytes);
    if (part_file.name == domain_name && (is_grid(type) || type == "UnstructuredGrid"))
        return add_domain(file, type, parts);
    if (is_grid(type)) {
        if (parts.grids++ == 0) parts.grid = file;
        return;
    }
    if (is_block_type(type)) return add_blocks(file, part, parts, depth);
    if (!type.empty()) return add_contents(read_vtk_xml(file, part), part_file.name, part, parts);
    if (takes_vtk_legacy(head)) return add_contents(read_vtk_legacy(file, part), part_file.name, part, parts);
    if (takes_wall_surface(head)) return add_surface(file, part_file.name, part, parts);
    refuse_vtk_file(file, "is neither a file of VTK nor a surface; a collection can name no others");
}

}  // namespace grainreel
