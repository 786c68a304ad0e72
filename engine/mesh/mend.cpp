#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

#include "engine/mesh/edge_table.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/weld.hpp"
#include "engine/mesh/winding.hpp"

namespace grainreel {
namespace {

constexpr double same_place = 1e-9;  // of the extent
constexpr double crack = 1e-5;       // of the extent, between open edges; floats are exact to 6e-8
constexpr double crack_room = 0.01;  // of the shortest open edge at a vertex
constexpr double slender = 1e-3;     // height over longest edge

using Box = Eigen::AlignedBox3d;

const Vec3& at(const TriangleMesh& mesh, std::int32_t vertex) {
    return mesh.vertices[static_cast<std::size_t>(vertex)];
}

Box box_of(const TriangleMesh& mesh) {
    Box box;
    for (const TriangleMesh::Triangle& triangle : mesh.triangles)
        for (const std::int32_t corner : triangle) box.extend(at(mesh, corner));
    return box;
}

// Its largest size, m.
double extent_of(const Box& box) {
    return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

std::string counted(std::int64_t count, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

// m, of a triangle.
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

// A triangle's corners by number, so that equal triangles are alike whatever their order.
struct Sorted {
    std::int32_t middle, high, triangle;
    bool operator<(const Sorted& o) const {
        return std::array{middle, high, triangle} < std::array{o.middle, o.high, o.triangle};
    }
};

// The first one of equal triangles stays.
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
        sorted[next[static_cast<std::size_t>(t[0])]++] = {t[1], t[2], static_cast<std::int32_t>(i)};
    }
    std::vector<char> doubled(mesh.triangles.size(), 0);
    for (std::size_t low = 0; low + 1 < begins.size(); ++low) {
        const auto first = sorted.begin() + static_cast<std::ptrdiff_t>(begins[low]),
                   end = sorted.begin() + static_cast<std::ptrdiff_t>(begins[low + 1]);
        std::sort(first, end);
        for (auto it = first; it != end && it + 1 != end; ++it)
            if (it->middle == it[1].middle && it->high == it[1].high)
                doubled[static_cast<std::size_t>(it[1].triangle)] = 1;
    }
    std::size_t i = 0;
    return static_cast<std::int64_t>(
        std::erase_if(mesh.triangles, [&](const TriangleMesh::Triangle&) { return doubled[i++] != 0; }));
}

// Vertices along open edges that roundings have set apart.
std::int64_t close_cracks(TriangleMesh& mesh, double extent) {
    std::vector<double> room(mesh.vertices.size(), 0);
    EdgeTable(mesh).each([&](std::int32_t low, std::span<const EdgeSide> sides) {
        if (sides.size() != 1) return;
        const double length = crack_room * (at(mesh, low) - at(mesh, sides[0].high)).norm();
        for (const std::int32_t vertex : {low, sides[0].high}) {
            double& least = room[static_cast<std::size_t>(vertex)];
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

}  // namespace grainreel
