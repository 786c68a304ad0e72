#include "render/page/bed/thin_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <unordered_map>

namespace grainreel {
namespace {

using Triangle = TriangleMesh::Triangle;

double area_of(const TriangleMesh& mesh) {
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
        const Vec3& b = mesh.vertices[static_cast<std::size_t>(t[1])];
        const Vec3& c = mesh.vertices[static_cast<std::size_t>(t[2])];
        area += 0.5 * (b - a).cross(c - a).norm();
    }
    return area;
}

// The vertices of a cell become one.
ThinnedMesh clustered(const TriangleMesh& mesh, const Vec3& low, double cell) {
    ThinnedMesh thin;
    thin.vertex_into.reserve(mesh.vertices.size());
    std::unordered_map<std::uint64_t, std::int32_t> cells;
    std::vector<double> members;
    for (const Vec3& vertex : mesh.vertices) {
        const Vec3 at = (vertex - low) / cell;
        std::uint64_t key = 0;
        for (const double part : {at.x(), at.y(), at.z()})
            key = key << 21 | static_cast<std::uint64_t>(std::clamp(part, 0.0, 2097151.0));
        const auto found = cells.try_emplace(key, static_cast<std::int32_t>(members.size())).first;
        const auto into = static_cast<std::size_t>(found->second);
        if (into == members.size()) {
            members.push_back(0);
            thin.mesh.vertices.emplace_back(0, 0, 0);
        }
        members[into] += 1;
        thin.mesh.vertices[into] += vertex;
        thin.vertex_into.push_back(found->second);
    }
    for (std::size_t i = 0; i < members.size(); ++i) thin.mesh.vertices[i] /= members[i];
    std::set<Triangle> seen;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = thin.vertex_into[static_cast<std::size_t>(mesh.triangles[t][k])];
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
