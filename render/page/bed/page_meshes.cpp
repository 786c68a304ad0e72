#include "render/page/bed/page_meshes.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <unordered_map>

#include "engine/mesh/surface.hpp"
#include "engine/state/body.hpp"
#include "render/page/embed.hpp"
#include "render/picture/mesh/scene_meshes.hpp"

namespace grainreel {

namespace {

using Edge = std::array<std::int32_t, 2>;

constexpr double most_level = 65535;  // highest level of a place in 16 bits
constexpr std::size_t least_triangles =
    200;  // a mesh with fewer triangles after thinning is left out, since its shape is lost

// What is known of a mesh before it is thinned.
struct Shape {
    const SceneMesh* mesh;
    std::int32_t body;
    std::shared_ptr<const MeshShape> drawn;
};

std::vector<Shape> shapes_of(const FilmedScene& scene) {
    const double edge_angle = scene.film.look.walls.edge_angle * std::numbers::pi / 180;
    std::vector<Shape> shapes;
    std::int32_t body = first_mesh_body(scene);
    for (const SceneMesh& mesh : scene.meshes) {
        if (mesh.surface)
            shapes.push_back({&mesh, body, mesh_shape(*mesh.surface, edge_angle, look_of(scene, mesh))});
        ++body;
    }
    return shapes;
}

// The number of triangles that each mesh may have: small meshes keep all of theirs, large ones share the
// rest.
std::vector<std::size_t> shares(const std::vector<Shape>& shapes, std::size_t most) {
    std::vector<std::size_t> order(shapes.size()), share(shapes.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto size = [&](std::size_t i) {
        return static_cast<std::size_t>(shapes[i].mesh->surface->size());
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return size(a) < size(b); });
    for (std::size_t k = 0; k < order.size(); ++k) {
        share[order[k]] = std::min(size(order[k]), most / (order.size() - k));
        most -= share[order[k]];
    }
    return share;
}

std::uint32_t zigzag(std::int64_t change) {
    return static_cast<std::uint32_t>(change < 0 ? -2 * change - 1 : 2 * change);
}

void append_planes(std::vector<std::uint8_t>& bytes, const std::vector<std::uint32_t>& numbers, int planes) {
    for (int plane = 0; plane < planes; ++plane)
        for (const std::uint32_t number : numbers)
            bytes.push_back(static_cast<std::uint8_t>(number >> (8 * plane) & 0xff));
}

// Appends the corners one after another, as differences.
template <std::size_t corners>
void append_corners(std::vector<std::uint8_t>& bytes,
                    const std::vector<std::array<std::int32_t, corners>>& list) {
    for (std::size_t corner = 0; corner < corners; ++corner) {
        std::vector<std::uint32_t> changes;
        std::int64_t before = 0;
        for (const auto& one : list) {
            changes.push_back(zigzag(one[corner] - before));
            before = one[corner];
        }
        append_planes(bytes, changes, 3);
    }
}

void append_vertices(std::vector<std::uint8_t>& bytes, const std::vector<Vec3>& vertices,
                     const PageMesh& page) {
    for (int axis = 0; axis < 3; ++axis) {
        const double low = page.low[axis], size = page.high[axis] - low;
        std::vector<std::uint32_t> changes;
        std::uint16_t before = 0;
        for (const Vec3& vertex : vertices) {
            const auto number = static_cast<std::uint16_t>(
                size > 0 ? std::lround(std::clamp((vertex[axis] - low) / size, 0.0, 1.0) * most_level) : 0);
            const auto change = static_cast<std::int16_t>(static_cast<std::uint16_t>(number - before));
            changes.push_back(zigzag(change));
            before = number;
        }
        append_planes(bytes, changes, 2);
    }
}

// The feature edges of the whole mesh that thinning has not shrunk to a point. Of too many, the longest are
// kept.
std::vector<Edge> edges_of(const MeshShape& shape, const ThinnedMesh& thin, std::size_t most) {
    std::vector<Edge> edges;
    for (const MeshShape::Edge& edge : shape.edges) {
        if (!edge.feature) continue;
        const std::int32_t a = thin.vertex_into[edge.from], b = thin.vertex_into[edge.to];
        if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    if (edges.size() <= most) return edges;
    const auto length = [&](const Edge& edge) {
        return (thin.mesh.vertices[edge[1]] - thin.mesh.vertices[edge[0]]).squaredNorm();
    };
    std::stable_sort(edges.begin(), edges.end(),
                     [&](const Edge& a, const Edge& b) { return length(a) > length(b); });
    edges.resize(most);
    std::sort(edges.begin(), edges.end());
    return edges;
}

// The triangles in the page's order: solid ones, glass ones, and those that are solid on the side of their
// normal only.
std::vector<TriangleMesh::Triangle> triangles_of(const MeshShape& shape, const ThinnedMesh& thin,
                                                 PageMesh& page) {
    using Face = MeshShape::Face;
    std::vector<TriangleMesh::Triangle> solid, glass, sided;
    for (std::size_t t = 0; t < thin.mesh.triangles.size(); ++t) {
        TriangleMesh::Triangle corners = thin.mesh.triangles[t];
        const auto [front, back] = shape.sides[thin.triangle_from[t]];
        if (front != Face::glass && back != Face::glass)
            solid.push_back(corners);
        else if (front == Face::glass && back == Face::glass)
            glass.push_back(corners);
        else {
            if (front == Face::glass) std::swap(corners[1], corners[2]);
            sided.push_back(corners);
        }
    }
    page.glass = glass.size();
    page.sided = sided.size();
    solid.insert(solid.end(), glass.begin(), glass.end());
    solid.insert(solid.end(), sided.begin(), sided.end());
    return solid;
}

PageMesh append_mesh(std::vector<std::uint8_t>& bytes, const Shape& shape, std::size_t most) {
    PageMesh page;
    page.body = shape.body;
    page.name = shape.mesh->name;
    page.all_triangles = static_cast<std::size_t>(shape.mesh->surface->size());
    page.low = shape.mesh->surface->facts().low;
    page.high = shape.mesh->surface->facts().high;
    if (most < std::min(page.all_triangles, least_triangles)) return page;
    const ThinnedMesh thin = thinned(shape.mesh->surface->mesh(), most);
    const std::vector<TriangleMesh::Triangle> triangles = triangles_of(*shape.drawn, thin, page);
    const std::vector<Edge> edges = edges_of(*shape.drawn, thin, 1000 + triangles.size());
    page.vertices = thin.mesh.vertices.size();
    page.triangles = triangles.size();
    page.edges = edges.size();
    append_vertices(bytes, thin.mesh.vertices, page);
    append_corners(bytes, triangles);
    append_corners(bytes, edges);
    return page;
}

}  // namespace

std::vector<std::string> PageMeshes::notes() const {
    std::vector<std::string> notes;
    for (const PageMesh& mesh : meshes) {
        if (mesh.whole()) continue;
        notes.push_back(
            mesh.triangles == 0
                ? fmt::format("the mesh \"{}\" is not drawn; the page has no room for its {} triangles",
                              mesh.name, mesh.all_triangles)
                : fmt::format("the mesh \"{}\" is drawn with {} triangles that stand for its {}", mesh.name,
                              mesh.triangles, mesh.all_triangles));
    }
    return notes;
}

PageMeshes page_meshes(const FilmedScene& scene, std::size_t most_bytes, std::size_t most_triangles) {
    if (scene.meshes.empty()) return {};
    const std::vector<Shape> shapes = shapes_of(scene);
    while (true) {
        PageMeshes page;
        std::vector<std::uint8_t> bytes;
        const std::vector<std::size_t> share = shares(shapes, most_triangles);
        for (std::size_t k = 0; k < shapes.size(); ++k)
            page.meshes.push_back(append_mesh(bytes, shapes[k], share[k]));
        if (!bytes.empty()) page.packed = zlib_packed(bytes);
        if (page.packed.size() <= most_bytes) return page;
        most_triangles = static_cast<std::size_t>(0.9 * static_cast<double>(most_triangles) *
                                                  static_cast<double>(most_bytes) /
                                                  static_cast<double>(page.packed.size()));
    }
}

void take_meshes(Extent& box, const Scene& scene, const std::vector<State>& moments) {
    constexpr std::size_t most_moments = 24, most_vertices = 2000;
    const std::size_t stride = 1 + moments.size() / most_moments;
    auto body = static_cast<std::size_t>(first_mesh_body(scene));
    for (const SceneMesh& mesh : scene.meshes) {
        const std::size_t number = body++;
        if (!mesh.surface) continue;
        const std::vector<Vec3>& vertices = mesh.surface->mesh().vertices;
        const MeshFacts& facts = mesh.surface->facts();
        box.take(facts.low);
        box.take(facts.high);
        for (std::size_t k = 0; k < moments.size(); k += stride) {
            const BodyPose pose = moments[k].body(number);
            for (std::size_t v = 0; v < vertices.size(); v += 1 + vertices.size() / most_vertices)
                box.take(pose.moved(vertices[v]));
        }
    }
}

namespace {

using Triangle = TriangleMesh::Triangle;

double area_of(const TriangleMesh& mesh) {
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3& a = mesh.vertices[t[0]];
        const Vec3& b = mesh.vertices[t[1]];
        const Vec3& c = mesh.vertices[t[2]];
        area += 0.5 * (b - a).cross(c - a).norm();
    }
    return area;
}

// Thins the mesh: all vertices in a cell become one.
ThinnedMesh clustered(const TriangleMesh& mesh, const Vec3& low, double cell) {
    ThinnedMesh thin;
    thin.vertex_into.reserve(mesh.vertices.size());
    std::unordered_map<std::uint64_t, std::int32_t> cells;
    std::vector<double> members;
    for (const Vec3& vertex : mesh.vertices) {
        const Vec3 in_cells = (vertex - low) / cell;
        std::uint64_t key = 0;
        for (const double part : {in_cells.x(), in_cells.y(), in_cells.z()})
            key = key << 21 | static_cast<std::uint64_t>(std::clamp(part, 0.0, 2097151.0));
        const auto slot = cells.try_emplace(key, static_cast<std::int32_t>(members.size())).first;
        const auto into = static_cast<std::size_t>(slot->second);
        if (into == members.size()) {
            members.push_back(0);
            thin.mesh.vertices.emplace_back(0, 0, 0);
        }
        members[into] += 1;
        thin.mesh.vertices[into] += vertex;
        thin.vertex_into.push_back(slot->second);
    }
    for (std::size_t i = 0; i < members.size(); ++i) thin.mesh.vertices[i] /= members[i];
    std::set<Triangle> seen;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = thin.vertex_into[mesh.triangles[t][k]];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        Triangle sorted = corners;
        std::sort(sorted.begin(), sorted.end());
        if (!seen.insert(sorted).second) continue;
        thin.mesh.triangles.push_back(corners);
        thin.triangle_from.push_back(static_cast<std::int32_t>(t));
    }
    return thin;
}

ThinnedMesh whole(const TriangleMesh& mesh) {
    ThinnedMesh all{mesh, std::vector<std::int32_t>(mesh.triangles.size()),
                    std::vector<std::int32_t>(mesh.vertices.size())};
    std::iota(all.triangle_from.begin(), all.triangle_from.end(), 0);
    std::iota(all.vertex_into.begin(), all.vertex_into.end(), 0);
    return all;
}

}  // namespace

ThinnedMesh thinned(const TriangleMesh& mesh, std::size_t most_triangles) {
    if (mesh.triangles.size() <= most_triangles) return whole(mesh);
    if (most_triangles == 0) return {};
    Vec3 low = mesh.vertices.front(), high = low;
    for (const Vec3& vertex : mesh.vertices) {
        low = low.cwiseMin(vertex);
        high = high.cwiseMax(vertex);
    }
    constexpr double triangles_a_cell = 2, least_growth = 1.05, most_growth = 4;
    const double most = static_cast<double>(most_triangles), extent = (high - low).maxCoeff();
    double cell = std::clamp(std::sqrt(triangles_a_cell * area_of(mesh) / most), 1e-6 * extent, extent);
    while (true) {
        ThinnedMesh thin = clustered(mesh, low, cell);
        if (thin.mesh.triangles.size() <= most_triangles) return thin;
        const double over = static_cast<double>(thin.mesh.triangles.size()) / most;
        cell *= std::clamp(std::sqrt(over), least_growth, most_growth);
    }
}

}  // namespace grainreel
