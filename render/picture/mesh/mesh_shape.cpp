// Finds the edges of a mesh that are drawn and the normals at its corners. This is done once for each mesh.
#include "render/picture/mesh/mesh_shape.hpp"
#include "engine/mesh/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {

namespace {

// The corner of a triangle that is neither of these vertices.
std::uint8_t third_corner(const TriangleMesh::Triangle& triangle, std::int32_t from, std::int32_t to) {
    for (std::uint8_t k = 0; k < 2; ++k)
        if (triangle[k] != from && triangle[k] != to) return k;
    return 2;
}

// rad: how much the surface turns across an edge. It is > 0 where the surface is convex, seen from its front.
double fold_at(const Surface& surface, std::int32_t t, int e) {
    const Neighbour& beyond = surface.neighbour(t, e);
    if (beyond.triangle < 0) return 0;
    double height = 0;  // m: height of the neighbour's third corner over the triangle
    for (int k = 0; k < 3; ++k) {
        const double one = surface.normal(t).dot(surface.corner(beyond.triangle, k) - surface.corner(t, e));
        if (std::abs(one) > std::abs(height)) height = one;
    }
    return height > 0 ? -turn_of(surface, t, beyond) : turn_of(surface, t, beyond);
}

// A twisted surface that is cut into triangles folds up and down from one triangle to the next. Such a fold
// is no edge.
bool is_ripple(const Surface& surface, std::int32_t t, int e) {
    constexpr double kMostRipple = std::numbers::pi / 3;
    constexpr double kFlat = std::numbers::pi / 90;
    const double fold = fold_at(surface, t, e);
    if (std::abs(fold) > kMostRipple || std::abs(fold) < kFlat) return false;
    const auto folds_back = [&](std::int32_t triangle) {
        for (int other = 0; other < 3; ++other)
            if (fold_at(surface, triangle, other) * fold < -0.25 * fold * fold) return true;
        return false;
    };
    return folds_back(t) && folds_back(surface.neighbour(t, e).triangle);
}

double angle_at(const Surface& surface, std::int32_t t, int corner) {
    const Vec3& at = surface.corner(t, corner);
    const Vec3 one = surface.corner(t, (corner + 1) % 3) - at,
               other = surface.corner(t, (corner + 2) % 3) - at;
    return std::atan2(one.cross(other).norm(), one.dot(other));
}

using EdgeFlags = std::vector<std::array<bool, 3>>;  // one for each triangle's edges
bool flag_at(const EdgeFlags& flags, std::int32_t t, int e) {
    return flags[t][e];
}

// Adds the normals of the triangles around a corner, each weighted by its angle there. It goes from `start`
// across edge `e` until it meets a feature edge or `start` again. Returns whether it came back to `start`.
bool go_round(const Surface& surface, const EdgeFlags& features, std::int32_t start, int corner, int e,
              Vec3& sum) {
    constexpr int kMost = 1000;  // more triangles meet at a vertex only where a mesh is no surface
    const TriangleMesh& mesh = surface.mesh();
    const std::int32_t vertex = mesh.triangles[start][corner];
    std::int32_t t = start;
    for (int i = 0; i < kMost && !flag_at(features, t, e); ++i) {
        const std::int32_t from = t;
        t = surface.neighbour(t, e).triangle;
        if (t == start) return true;
        const TriangleMesh::Triangle& corners = mesh.triangles[t];
        const auto k = static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
        if (k == 3) return false;
        sum += angle_at(surface, t, k) * surface.normal(t);
        e = surface.neighbour(t, k).triangle == from ? (k + 2) % 3 : k;
    }
    return false;
}

// Gives each corner of a triangle the mean of the normals around its vertex, as far as the next feature
// edges.
void add_corner_normals(const Surface& surface, const EdgeFlags& features, MeshShape& shape) {
    shape.corners.resize(shape.triangles.size());
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            Vec3 sum = angle_at(surface, t, k) * surface.normal(t);
            if (!go_round(surface, features, t, k, k, sum))
                go_round(surface, features, t, k, (k + 2) % 3, sum);
            const double length = sum.norm();
            shape.corners[t][k] = (length > 0 ? Vec3(sum / length) : surface.normal(t)).cast<float>();
        }
}

// Finds feature edges. A smooth surface also ends where normals flip or more than two triangles meet.
EdgeFlags feature_edges(const Surface& surface, double edge_angle) {
    EdgeFlags features(static_cast<std::size_t>(surface.size()));
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Neighbour& beyond = surface.neighbour(t, e);
            features[t][e] = beyond.triangle < 0 || beyond.flips ||
                             (turn_of(surface, t, beyond) > edge_angle && !is_ripple(surface, t, e));
        }
    return features;
}

// Says for each triangle whether it stands for a part of a twisted surface.
std::vector<char> rippled_triangles(const Surface& surface) {
    std::vector<char> rippled(static_cast<std::size_t>(surface.size()), 0);
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int e = 0; e < 3; ++e)
            if (is_ripple(surface, t, e)) rippled[t] = 1;
    return rippled;
}

void add_edges(const Surface& surface, const EdgeFlags& features, MeshShape& shape) {
    const std::vector<char> ripples = rippled_triangles(surface);
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int e = 0; e < 3; ++e) {
            const std::int32_t right = surface.neighbour(t, e).triangle;
            if (right >= 0 && right < t) continue;
            const TriangleMesh::Triangle& corners = shape.triangles[t];
            const std::int32_t from = corners[e], to = corners[(e + 1) % 3];
            const std::uint8_t third =
                right < 0 ? std::uint8_t{0} : third_corner(shape.triangles[right], from, to);
            const bool rippled = ripples[t] || (right >= 0 && ripples[right]);
            shape.edges.push_back({from, to, t, right, static_cast<std::uint8_t>((e + 2) % 3), third,
                                   flag_at(features, t, e), rippled});
        }
}

}  // namespace

double turn_of(const Surface& surface, std::int32_t triangle, const Neighbour& neighbour) {
    const double cosine = surface.normal(triangle).dot(surface.normal(neighbour.triangle));
    return std::acos(std::clamp(neighbour.flips ? -cosine : cosine, -1.0, 1.0));
}

std::vector<std::int32_t> smooth_patches(const Surface& surface, double edge_angle) {
    std::vector<std::int32_t> patch(static_cast<std::size_t>(surface.size()), -1);
    std::vector<std::int32_t> waiting;
    std::int32_t count = 0;
    for (std::int32_t start = 0; start < surface.size(); ++start) {
        if (patch[start] >= 0) continue;
        patch[start] = count;
        waiting.push_back(start);
        while (!waiting.empty()) {
            const std::int32_t t = waiting.back();
            waiting.pop_back();
            for (int e = 0; e < 3; ++e) {
                const Neighbour& beyond = surface.neighbour(t, e);
                if (beyond.triangle < 0 || patch[beyond.triangle] >= 0) continue;
                if (beyond.flips || turn_of(surface, t, beyond) > edge_angle) continue;
                patch[beyond.triangle] = count;
                waiting.push_back(beyond.triangle);
            }
        }
        ++count;
    }
    return patch;
}

std::shared_ptr<const MeshShape> mesh_shape(const Surface& surface, double edge_angle, MeshLook look) {
    auto shape = std::make_shared<MeshShape>();
    shape->vertices = surface.mesh().vertices;
    shape->triangles = surface.mesh().triangles;
    shape->normals.reserve(shape->triangles.size());
    for (std::int32_t t = 0; t < surface.size(); ++t) shape->normals.push_back(surface.normal(t));
    const EdgeFlags features = feature_edges(surface, edge_angle);
    add_corner_normals(surface, features, *shape);
    add_edges(surface, features, *shape);
    shape->sides = find_sides(surface, edge_angle, look);
    return shape;
}

}  // namespace grainreel
