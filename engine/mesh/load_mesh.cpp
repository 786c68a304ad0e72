#include "engine/mesh/load_mesh.hpp"

#include <fmt/format.h>
#include <xxhash.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

#include "engine/base/word_reader.hpp"
#include "engine/mesh/file/mesh_readers.hpp"
#include "engine/mesh/mesh_edges.hpp"
#include "engine/mesh/winding.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

std::string hash_of(std::string_view bytes) {
    return fmt::format("{:016x}", XXH64(bytes.data(), bytes.size(), 0));
}

void put_in_place(TriangleMesh& mesh, const MeshPlacement& placement, const fs::path& file) {
    const Eigen::Matrix3d turn = placement.rotation.toRotationMatrix();
    const bool turned = !turn.isIdentity(0);
    for (Vec3& vertex : mesh.vertices) {
        vertex *= placement.scale;
        if (turned) vertex = turn * vertex;
        vertex += placement.position;
        if (!(vertex.cwiseAbs().maxCoeff() <= largest_coordinate))
            refuse_file(
                file,
                fmt::format("a corner would stand {:g} m from the origin; give another scale or position",
                            vertex.norm()));
    }
}

constexpr double same_place = 1e-9;  // as a share of the extent
constexpr double crack =
    1e-5;  // greatest width of a crack between open edges, as a share of the extent; floats are exact to 6e-8
constexpr double crack_room = 0.01;  // as a share of the shortest open edge at a vertex
constexpr double slender = 1e-3;     // height divided by longest edge

using Box = Eigen::AlignedBox3d;

const Vec3& at(const TriangleMesh& mesh, std::int32_t vertex) {
    return mesh.vertices[vertex];
}

Box box_of(const TriangleMesh& mesh) {
    Box box;
    for (const TriangleMesh::Triangle& triangle : mesh.triangles)
        for (const std::int32_t corner : triangle) box.extend(at(mesh, corner));
    return box;
}

// The largest size (m) of a box.
double extent_of(const Box& box) {
    return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

std::string counted(std::int64_t count, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

// Sizes of a triangle, in m.
struct Size {
    double longest, height;
};

Size size_of(const TriangleMesh& mesh, const TriangleMesh::Triangle& triangle) {
    const Vec3 ab = at(mesh, triangle[1]) - at(mesh, triangle[0]),
               ac = at(mesh, triangle[2]) - at(mesh, triangle[0]);
    const double longest = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
    return {longest, longest > 0 ? ab.cross(ac).norm() / longest : 0};
}

std::int64_t drop_flat(TriangleMesh& mesh, double least_height) {
    return static_cast<std::int64_t>(std::erase_if(mesh.triangles, [&](const TriangleMesh::Triangle& t) {
        return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || !(size_of(mesh, t).height > least_height);
    }));
}

// A triangle with its corners sorted by number, so that the order of the corners does not matter when
// triangles are compared.
struct Sorted {
    std::int32_t middle, high, triangle;
    bool operator<(const Sorted& o) const {
        return std::array{middle, high, triangle} < std::array{o.middle, o.high, o.triangle};
    }
};

// Drops all but the first of equal triangles. Returns how many were dropped.
std::int64_t drop_doubled(TriangleMesh& mesh) {
    std::vector<std::size_t> begins(mesh.vertices.size() + 1, 0);
    for (const TriangleMesh::Triangle& t : mesh.triangles)
        ++begins[static_cast<std::size_t>(std::min({t[0], t[1], t[2]})) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
    std::vector<Sorted> sorted(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        TriangleMesh::Triangle t = mesh.triangles[i];
        std::sort(t.begin(), t.end());
        sorted[next[t[0]]++] = {t[1], t[2], static_cast<std::int32_t>(i)};
    }
    std::vector<char> doubled(mesh.triangles.size(), 0);
    for (std::size_t low = 0; low + 1 < begins.size(); ++low) {
        const auto first = sorted.begin() + static_cast<std::ptrdiff_t>(begins[low]),
                   end = sorted.begin() + static_cast<std::ptrdiff_t>(begins[low + 1]);
        std::sort(first, end);
        for (auto it = first; it != end && it + 1 != end; ++it)
            if (it->middle == it[1].middle && it->high == it[1].high) doubled[it[1].triangle] = 1;
    }
    std::size_t i = 0;
    return static_cast<std::int64_t>(
        std::erase_if(mesh.triangles, [&](const TriangleMesh::Triangle&) { return doubled[i++] != 0; }));
}

// The vertices and the rule by which they are joined. Two vertices are joined if their distance is at most
// `reach` (m) and at most the `room` of each.
struct Welding {
    const std::vector<Vec3>& vertices;
    double reach = 0;
    std::vector<double> room;  // m, for each vertex; if empty, only `reach` counts
};

// Vertices in a hash table of cells. A cell is eight reaches wide, so that most vertices look into one or two
// cells, and no cell can have many vertices that are not joined.
class Cells {
  public:
    Cells(const Welding& welding, std::size_t count)
        : welding_(welding), width_(8 * welding.reach), next_(welding.vertices.size(), -1) {
        std::size_t size = 64;
        while (size < count + count / 2) size *= 2;
        heads_.assign(size, -1);
    }

    // The first vertex that this one can be joined with, or -1.
    std::int32_t match(std::int32_t vertex) const {
        const Vec3& place = welding_.vertices[vertex];
        std::array<std::int64_t, 3> low{}, high{};
        for (int k = 0; k < 3; ++k) {
            low[k] = cell(place[k] - welding_.reach);
            high[k] = cell(place[k] + welding_.reach);
        }
        std::int32_t found = -1;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    for (std::int32_t i = heads_[slot(x, y, z)]; i >= 0; i = next_[i])
                        if ((found < 0 || i < found) && fits(i, vertex)) found = i;
        return found;
    }

    void add(std::int32_t vertex) {
        const Vec3& place = welding_.vertices[vertex];
        std::int32_t& head = heads_[slot(cell(place.x()), cell(place.y()), cell(place.z()))];
        next_[vertex] = head;
        head = vertex;
    }

  private:
    std::int64_t cell(double x) const { return static_cast<std::int64_t>(std::floor(x / width_)); }

    std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
        std::uint64_t mixed = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u;
        mixed = (mixed ^ (mixed >> 29) ^ static_cast<std::uint64_t>(y)) * 0xbf58476d1ce4e5b9u;
        mixed = (mixed ^ (mixed >> 31) ^ static_cast<std::uint64_t>(z)) * 0x94d049bb133111ebu;
        return static_cast<std::size_t>(mixed ^ (mixed >> 30)) & (heads_.size() - 1);
    }

    bool fits(std::int32_t i, std::int32_t j) const {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        double reach = welding_.reach;
        if (!welding_.room.empty()) reach = std::min({reach, welding_.room[a], welding_.room[b]});
        return (welding_.vertices[a] - welding_.vertices[b]).squaredNorm() <= reach * reach;
    }

    const Welding& welding_;
    double width_;
    std::vector<std::int32_t> heads_, next_;
};

// Looks at the vertices named in `which` (all different, rising). For each vertex of the mesh it gives the
// one that takes its place: the vertex itself, or the first one looked at that it can be joined with.
std::vector<std::int32_t> joined(const Welding& welding, const std::vector<std::int32_t>& which) {
    std::vector<std::int32_t> place(welding.vertices.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<std::int32_t>(i);
    Cells cells(welding, which.size());
    for (const std::int32_t vertex : which) {
        const std::int32_t match = cells.match(vertex);
        if (match < 0)
            cells.add(vertex);
        else
            place[vertex] = match;
    }
    return place;
}

// Replaces the vertices of the triangles as `place_of` says. Returns how many vertices were replaced.
std::int64_t replace_vertices(TriangleMesh& mesh, const std::vector<std::int32_t>& place_of) {
    std::int64_t gone = 0;
    for (std::size_t i = 0; i < place_of.size(); ++i) gone += place_of[i] != static_cast<std::int32_t>(i);
    if (gone == 0) return 0;
    for (TriangleMesh::Triangle& triangle : mesh.triangles)
        for (std::int32_t& corner : triangle) corner = place_of[corner];
    return gone;
}

// Drops vertices that no triangle has. The others are put in the order in which triangles name them.
void drop_unused_vertices(TriangleMesh& mesh) {
    std::vector<std::int32_t> number(mesh.vertices.size(), -1);
    std::vector<Vec3> vertices;
    vertices.reserve(mesh.vertices.size());
    for (TriangleMesh::Triangle& triangle : mesh.triangles)
        for (std::int32_t& corner : triangle) {
            std::int32_t& now = number[corner];
            if (now < 0) {
                now = static_cast<std::int32_t>(vertices.size());
                vertices.push_back(mesh.vertices[corner]);
            }
            corner = now;
        }
    mesh.vertices = std::move(vertices);
}

// Joins vertices at open edges that rounding has moved apart.
std::int64_t close_cracks(TriangleMesh& mesh, double extent) {
    std::vector<double> room(mesh.vertices.size(), 0);
    EdgeTable(mesh).each([&](std::int32_t low, std::span<const EdgeSide> sides) {
        if (sides.size() != 1) return;
        const double length = crack_room * (at(mesh, low) - at(mesh, sides[0].high)).norm();
        for (const std::int32_t vertex : {low, sides[0].high}) {
            double& least = room[vertex];
            least = least > 0 ? std::min(least, length) : length;
        }
    });
    std::vector<std::int32_t> open;
    for (std::size_t i = 0; i < room.size(); ++i)
        if (room[i] > 0) open.push_back(static_cast<std::int32_t>(i));
    if (open.empty()) return 0;
    return replace_vertices(mesh, joined({mesh.vertices, crack * extent, std::move(room)}, open));
}

std::int64_t weld(TriangleMesh& mesh, double reach) {
    std::vector<std::int32_t> all(mesh.vertices.size());
    std::iota(all.begin(), all.end(), 0);
    return replace_vertices(mesh, joined({mesh.vertices, reach, {}}, all));
}

void tell(MeshFacts& facts, std::int64_t cracks) {
    const auto line = [&](std::int64_t count, std::string_view one, std::string_view many) {
        if (count > 0) facts.mended.push_back(counted(count, one, many));
    };
    line(facts.welded - cracks, "vertex was joined with one in its place",
         "vertices were joined with others in their place");
    line(cracks, "vertex of an open edge was joined with one a hair (1e-5 of the extent) away",
         "vertices of open edges were joined with others a hair (1e-5 of the extent) away");
    line(facts.dropped, "triangle without area was left out", "triangles without area were left out");
    line(facts.doubled, "triangle that was there twice counts once",
         "triangles that were there twice count once");
    line(facts.flipped, "triangle was turned round, to face as its neighbours do",
         "triangles were turned round, to face as their neighbours do");
}

}  // namespace

void mend(TriangleMesh& mesh, MeshFacts& facts) {
    drop_unused_vertices(mesh);
    const double extent = extent_of(box_of(mesh)), thin = same_place * extent;
    facts.welded = extent > 0 ? weld(mesh, thin) : 0;
    facts.dropped = drop_flat(mesh, thin);
    facts.doubled = drop_doubled(mesh);
    const std::int64_t cracks = close_cracks(mesh, extent);
    facts.welded += cracks;
    if (cracks > 0) {
        facts.dropped += drop_flat(mesh, thin);
        facts.doubled += drop_doubled(mesh);
    }
    drop_unused_vertices(mesh);

    const Winding winding = wind_alike(mesh);
    facts.flipped = winding.flipped;
    facts.solids = winding.solids;
    facts.open_edges = winding.open_edges;
    facts.crowded_edges = winding.crowded_edges;
    facts.triangles = static_cast<std::int64_t>(mesh.triangles.size());
    facts.vertices = static_cast<std::int64_t>(mesh.vertices.size());
    facts.slender = std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
        const Size size = size_of(mesh, triangle);
        return size.height < slender * size.longest;
    });
    const Box box = box_of(mesh);
    facts.low = box.isEmpty() ? Vec3(0, 0, 0) : box.min();
    facts.high = box.isEmpty() ? Vec3(0, 0, 0) : box.max();
    facts.mended.clear();
    tell(facts, cracks);
}

LoadedMesh load_mesh(const fs::path& file, const MeshPlacement& placement) {
    const std::string bytes = mesh_bytes(file);
    const MeshFormat format = format_of(file, bytes);
    LoadedMesh loaded;
    loaded.hash = hash_of(bytes);
    loaded.facts.format = name_of(format);
    loaded.mesh = read_mesh(format, file, bytes);
    loaded.facts.read = static_cast<std::int64_t>(loaded.mesh.triangles.size());
    if (loaded.mesh.empty()) refuse_file(file, fmt::format("this {} has no triangles", loaded.facts.format));
    put_in_place(loaded.mesh, placement, file);
    mend(loaded.mesh, loaded.facts);
    if (loaded.mesh.empty()) refuse_file(file, "all triangles of this mesh are without area");
    return loaded;
}

std::string hash_of_file(const fs::path& file) {
    return hash_of(mesh_bytes(file));
}

}  // namespace grainreel
