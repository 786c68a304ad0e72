#include "engine/files/foreign/vtk/wall_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"
#include "engine/mesh/file/mesh_bytes.hpp"
#include "engine/mesh/file/mesh_readers.hpp"
#include "engine/mesh/file/words.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

// A solid of an ASCII STL: its name, and how many triangles it has.
struct Solid {
    std::string name;
    std::size_t triangles = 0;
};

std::string_view first_line(std::string_view text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

std::string name_behind(std::string_view line) {
    Words words(line);
    words.next();
    const std::string_view left = words.left();
    const std::size_t begin = left.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return std::string(left.substr(begin, left.find_last_not_of(" \t") - begin + 1));
}

// The text has been read once and is sound.
std::vector<Solid> solids_of(std::string_view bytes) {
    std::vector<Solid> solids;
    Words words(bytes);
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
            std::int32_t& mine = number[static_cast<std::size_t>(corner)];
            if (mine < 0) {
                mine = static_cast<std::int32_t>(wall.mesh.vertices.size());
                wall.mesh.vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
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
    // Few: each solid costs a look at all vertices.
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

class WallSurface : public RawFile {
  public:
    explicit WallSurface(fs::path file) : file_(std::move(file)) {
        const std::string bytes = all_bytes(file_, largest_mesh_file);
        const MeshFormat format = format_of(file_, bytes);
        if (read_mesh(format, file_, bytes).empty())
            refuse_vtk_file(file_, fmt::format("this {} has no triangles", name_of(format)));
        facts_.format = name_of(format);
        moments_.push_back({std::nullopt, std::nullopt, 0, false, true});
    }
    const RawFacts& facts() const override { return facts_; }
    const std::vector<RawMoment>& moments() const override { return moments_; }
    RawFrame read(std::size_t) const override {
        RawFrame frame;
        frame.walls = read_wall_surface(file_);
        return frame;
    }

  private:
    fs::path file_;
    RawFacts facts_;
    std::vector<RawMoment> moments_;
};

std::unique_ptr<RawFile> open_wall_surface(const fs::path& file) {
    return std::make_unique<WallSurface>(file);
}

bool is_text(std::string_view bytes) {
    return bytes.find('\0') == std::string_view::npos;
}

// A line "v 0 0 1", "f 1 2 3" or "mtllib a.mtl" before any line of something else.
bool is_obj(std::string_view bytes) {
    Words words(bytes);
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

// Whether all facets of a binary STL that the first bytes hold have places that walls can have. Of a packed
// file the size that it has unpacked is not known.
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

bool takes_wall_surface(const FileHead& head) {
    const std::string_view bytes = head.bytes;
    if (bytes.size() > 3 && bytes.starts_with("ply") && std::strchr("\r\n \t", bytes[3]) != nullptr)
        return true;
    if (bytes.size() >= 84 && !is_text(bytes)) {
        std::uint32_t count = 0;
        std::memcpy(&count, bytes.data() + 80, sizeof count);
        // The size of a packed file is that of its packed bytes.
        const std::uint64_t size = 84 + 50 * std::uint64_t{count};
        return size == head.size || (bytes.size() < kHeadBytes && size == bytes.size()) ||
               (bytes.size() >= kHeadBytes && size > head.size && holds_facets(bytes)) ||
               same_word(bytes.substr(0, 5), "solid");
    }
    Words words(bytes);
    const std::string_view word = words.next();
    if (same_word(word, "solid")) {
        words.skip_line();
        const std::string_view next = words.next();
        return same_word(next, "facet") || same_word(next, "endsolid") || next.empty();
    }
    return is_text(bytes) && is_obj(bytes);
}

std::vector<RawWall> read_wall_surface(const fs::path& file) {
    const std::string bytes = all_bytes(file, largest_mesh_file);
    const MeshFormat format = format_of(file, bytes);
    TriangleMesh mesh = read_mesh(format, file, bytes);
    const bool may_have_several = format == MeshFormat::ascii_stl;
    return split(std::move(mesh), may_have_several ? solids_of(bytes) : std::vector<Solid>());
}

RawFormat wall_surface_format() {
    return {"surface", "surfaces of walls (STL, OBJ, PLY)", &takes_wall_surface, &open_wall_surface};
}

}  // namespace grainreel
