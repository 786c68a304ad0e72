#include "engine/files/foreign/vtk/vtk_parts.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"
#include "engine/files/foreign/vtk/vtk_xml.hpp"
#include "engine/files/foreign/vtk/xml_arrays.hpp"
#include "engine/mesh/file/mesh_readers.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr int most_depth = 4;  // most levels of lists within lists
constexpr std::string_view domain_name = "Domain";

// The box that LIGGGHTS writes as a rectilinear grid of one cell.
std::optional<WorldCell> box_of_grid(const Content& content, const XmlTree& tree) {
    const XmlElement* grid = tree.root.child("RectilinearGrid");
    const XmlElement* piece = grid == nullptr ? nullptr : grid->child("Piece");
    const XmlElement* axes = piece == nullptr ? nullptr : piece->child("Coordinates");
    if (axes == nullptr || axes->children.size() != 3) return std::nullopt;
    const XmlArrays arrays(content, tree);
    WorldCell box;
    std::size_t k = 0;
    for (const XmlElement& child : axes->children) {
        const std::vector<double> values = arrays.numbers(child, std::nullopt, true);
        if (values.empty()) return std::nullopt;
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const auto axis = static_cast<Eigen::Index>(k);
        box.origin[axis] = *low;
        box.edges[k++][axis] = *high - *low;
    }
    return box;
}

// The tilted box that LIGGGHTS writes as one hexahedron.
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
        const Content content(file);
        box = box_of_grid(content, xml_tree(content));
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
        refuse_file(file, "lists of files within lists without an end; name the files themselves");
    for (const VtkPartFile& block : files_of_blocks(file, xml_tree(Content(file)))) {
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
    const FileStart head = unpacked_head(file);
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
    refuse_file(file, "is neither a file of VTK nor a surface; a collection can name no others");
}

namespace {

namespace fs = std::filesystem;

// A solid of a text STL: its name and number of triangles.
struct Solid {
    std::string name;
    std::size_t triangles = 0;
};

std::string_view first_line(std::string_view text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

std::string name_behind(std::string_view line) {
    WordReader words(line);
    words.next();
    const std::string_view left = words.left();
    const std::size_t begin = left.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return std::string(left.substr(begin, left.find_last_not_of(" \t") - begin + 1));
}

// Finds the solids. The text was read before and is sound.
std::vector<Solid> solids_of(std::string_view bytes) {
    std::vector<Solid> solids;
    WordReader words(bytes);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (same_word(word, "solid")) {
            solids.push_back({name_behind(first_line(
                {word.data(), static_cast<std::size_t>(bytes.data() + bytes.size() - word.data())}))});
            words.skip_line();
        } else if (same_word(word, "endsolid")) {
            words.skip_line();
        } else if (same_word(word, "endfacet") && !solids.empty()) {
            ++solids.back().triangles;
        }
    }
    return solids;
}

RawWall wall_of(std::string name, const TriangleMesh& mesh, std::size_t from, std::size_t count) {
    RawWall wall{std::move(name), {}};
    std::vector<std::int32_t> number(mesh.vertices.size(), -1);
    for (std::size_t i = from; i < from + count; ++i) {
        TriangleMesh::Triangle triangle = mesh.triangles[i];
        for (std::int32_t& corner : triangle) {
            std::int32_t& mine = number[corner];
            if (mine < 0) {
                mine = static_cast<std::int32_t>(wall.mesh.vertices.size());
                wall.mesh.vertices.push_back(mesh.vertices[corner]);
            }
            corner = mine;
        }
        wall.mesh.triangles.push_back(triangle);
    }
    wall.cells.rows = wall.mesh.triangles.size();
    return wall;
}

std::vector<RawWall> split(TriangleMesh&& mesh, const std::vector<Solid>& solids) {
    std::size_t all = 0;
    for (const Solid& solid : solids) all += solid.triangles;
    std::vector<RawWall> walls;
    // More than 1000 solids are not split: wall_of() goes through all vertices for each of them.
    if (solids.size() < 2 || solids.size() > 1000 || all != mesh.triangles.size()) {
        const std::size_t triangles = mesh.triangles.size();
        walls.push_back(
            {solids.size() == 1 ? solids[0].name : std::string(), std::move(mesh), {triangles, {}}});
        return walls;
    }
    std::size_t from = 0;
    for (const Solid& solid : solids) {
        if (solid.triangles > 0) walls.push_back(wall_of(solid.name, mesh, from, solid.triangles));
        from += solid.triangles;
    }
    return walls;
}

// The bytes of a surface. A packed one may unpack to as much as such files do.
std::string mesh_content(const fs::path& file) {
    if (packing_of(file) == Packing::none) return all_bytes(file, largest_mesh_file);
    constexpr std::uint64_t some = std::uint64_t{16} << 20, most_growth = 16;
    std::error_code ignored;
    return all_bytes(
        file, std::min<std::uint64_t>(largest_mesh_file, some + most_growth * fs::file_size(file, ignored)));
}

class WallSurface : public RawFile {
  public:
    explicit WallSurface(fs::path file) : RawFile(std::move(file)) {
        const std::string bytes = mesh_content(file_);
        const MeshFormat format = format_of(file_, bytes);
        if (read_mesh(format, file_, bytes).empty())
            refuse_file(file_, fmt::format("this {} has no triangles", name_of(format)));
        facts_.format = name_of(format);
        moments_.push_back({std::nullopt, std::nullopt, 0, false, true});
    }
    RawFrame read(std::size_t) const override {
        RawFrame frame;
        frame.walls = read_wall_surface(file_);
        return frame;
    }
};

std::unique_ptr<RawFile> open_wall_surface(const fs::path& file) {
    return std::make_unique<WallSurface>(file);
}

bool is_text(std::string_view bytes) {
    return bytes.find('\0') == std::string_view::npos;
}

// Whether the text is an OBJ: a vertex "v 0 0 1" comes, and only comments, names, materials and normals stand
// before it.
bool is_obj(std::string_view bytes) {
    WordReader words(bytes);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const bool comment = word.starts_with('#');
        if (word == "v") return number_in(words.next_in_line()).has_value();
        constexpr std::string_view others[] = {"o", "g", "s", "mtllib", "usemtl", "vn", "vt", "vp"};
        if (!comment && std::find(std::begin(others), std::end(others), word) == std::end(others))
            return false;
        words.skip_line();
    }
    return false;
}

// Whether the facets among the first bytes of a binary STL have places that walls can have. This serves
// packed files, whose unpacked size is not known.
bool holds_facets(std::string_view bytes) {
    constexpr float farthest = 1e7F;
    if (bytes.size() < 84 + 50) return false;
    for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
        float numbers[12];
        std::memcpy(numbers, bytes.data() + at, sizeof numbers);
        for (const float number : numbers)
            if (!(std::abs(number) < farthest)) return false;
        if (std::all_of(numbers + 3, numbers + 12, [](float number) { return number == 0; })) return false;
    }
    return true;
}

}  // namespace

bool takes_wall_surface(const FileStart& head) {
    const std::string_view bytes = head.bytes;
    if (bytes.size() > 3 && bytes.starts_with("ply") && std::strchr("\r\n \t", bytes[3]) != nullptr)
        return true;
    if (bytes.size() >= 84 && !is_text(bytes)) {
        std::uint32_t count = 0;
        std::memcpy(&count, bytes.data() + 80, sizeof count);
        // `size` is that of the unpacked file; head.size is that of the packed bytes if the file is packed.
        const std::uint64_t size = 84 + 50 * std::uint64_t{count};
        return size == head.size || (bytes.size() < kHeadBytes && size == bytes.size()) ||
               (bytes.size() >= kHeadBytes && size > head.size && holds_facets(bytes)) ||
               same_word(bytes.substr(0, 5), "solid");
    }
    WordReader words(bytes);
    const std::string_view word = words.next();
    if (same_word(word, "solid")) {
        words.skip_line();
        const std::string_view next = words.next();
        return same_word(next, "facet") || same_word(next, "endsolid") || next.empty();
    }
    return is_text(bytes) && is_obj(bytes);
}

std::vector<RawWall> read_wall_surface(const fs::path& file) {
    const std::string bytes = mesh_content(file);
    const MeshFormat format = format_of(file, bytes);
    TriangleMesh mesh = read_mesh(format, file, bytes);
    const bool may_have_several = format == MeshFormat::ascii_stl;
    return split(std::move(mesh), may_have_several ? solids_of(bytes) : std::vector<Solid>());
}

RawFormat wall_surface_format() {
    return {"surface", "surfaces of walls (STL, OBJ, PLY)", &takes_wall_surface, &open_wall_surface};
}

}  // namespace grainreel
