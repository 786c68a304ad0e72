#include "render/picture/mesh/mesh_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/picture/mesh/mesh_sides.hpp"

namespace grainreel {
namespace {

// The triangles around each vertex, one list after the other.
struct Fans {
    std::vector<std::int32_t> first, triangle;
};
Fans fans_of(const TriangleMesh& mesh) {
    Fans fans;
    fans.first.assign(mesh.vertices.size() + 1, 0);
    for (const TriangleMesh::Triangle& t : mesh.triangles)
        for (const std::int32_t v : t) ++fans.first[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 0; v + 1 < fans.first.size(); ++v) fans.first[v + 1] += fans.first[v];
    fans.triangle.resize(3 * mesh.triangles.size());
    std::vector<std::int32_t> next(fans.first.begin(), fans.first.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::int32_t v : mesh.triangles[t])
            fans.triangle[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] =
                static_cast<std::int32_t>(t);
    return fans;
}

// The mean of the normals around a corner that turn less than a feature edge does, each by its area.
void add_corner_normals(const Surface& surface, double edge_angle, MeshShape& shape) {
    const Fans fans = fans_of(surface.mesh());
    const double least = std::cos(edge_angle);
    std::vector<double> area(shape.triangles.size());
    for (std::int32_t t = 0; t < surface.size(); ++t) area[static_cast<std::size_t>(t)] = surface.area(t);
    shape.corners.resize(shape.triangles.size());
    for (std::size_t t = 0; t < shape.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(shape.triangles[t][k]);
            Vec3 sum = Vec3::Zero();
            for (std::int32_t i = fans.first[v]; i < fans.first[v + 1]; ++i) {
                const auto other = static_cast<std::size_t>(fans.triangle[static_cast<std::size_t>(i)]);
                if (shape.normals[other].dot(shape.normals[t]) >= least)
                    sum += area[other] * shape.normals[other];
            }
            const double length = sum.norm();
            shape.corners[t][k] = (length > 0 ? Vec3(sum / length) : shape.normals[t]).cast<float>();
        }
}

// Which corner of a triangle is neither of these vertices.
std::uint8_t third_corner(const TriangleMesh::Triangle& triangle, std::int32_t from, std::int32_t to) {
    for (std::uint8_t k = 0; k < 2; ++k)
        if (triangle[k] != from && triangle[k] != to) return k;
    return 2;
}

// rad, how much the surface turns across an edge: > 0 where it is convex for who stands on its front.
double fold_at(const Surface& surface, std::int32_t t, int e) {
    const Neighbour& beyond = surface.neighbour(t, e);
    if (beyond.triangle < 0) return 0;
    double height = 0;  // of the neighbour's third corner over the triangle
    for (int k = 0; k < 3; ++k) {
        const double one = surface.normal(t).dot(surface.corner(beyond.triangle, k) - surface.corner(t, e));
        if (std::abs(one) > std::abs(height)) height = one;
    }
    return height > 0 ? -turn_of(surface, t, beyond) : turn_of(surface, t, beyond);
}

// Twisted surfaces that are cut into triangles fold up and down from one to the next. No such fold is an
// edge.
bool is_ripple(const Surface& surface, std::int32_t t, int e) {
    constexpr double kMostRipple = std::numbers::pi / 3;
    const double fold = fold_at(surface, t, e);
    if (std::abs(fold) > kMostRipple) return false;
    const auto folds_back = [&](std::int32_t triangle) {
        for (int other = 0; other < 3; ++other)
            if (fold_at(surface, triangle, other) * fold < -0.25 * fold * fold) return true;
        return false;
    };
    return folds_back(t) && folds_back(surface.neighbour(t, e).triangle);
}

void add_edges(const Surface& surface, double edge_angle, MeshShape& shape) {
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Neighbour& beyond = surface.neighbour(t, e);
            const std::int32_t right = beyond.triangle;
            if (right >= 0 && right < t) continue;
            const TriangleMesh::Triangle& corners = shape.triangles[static_cast<std::size_t>(t)];
            const std::int32_t from = corners[static_cast<std::size_t>(e)],
                               to = corners[static_cast<std::size_t>((e + 1) % 3)];
            const bool feature =
                right < 0 || (turn_of(surface, t, beyond) > edge_angle && !is_ripple(surface, t, e));
            const std::uint8_t third =
                right < 0 ? std::uint8_t{0}
                          : third_corner(shape.triangles[static_cast<std::size_t>(right)], from, to);
            shape.edges.push_back(
                {from, to, t, right, static_cast<std::uint8_t>((e + 2) % 3), third, feature});
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
        if (patch[static_cast<std::size_t>(start)] >= 0) continue;
        patch[static_cast<std::size_t>(start)] = count;
        waiting.push_back(start);
        while (!waiting.empty()) {
            const std::int32_t t = waiting.back();
            waiting.pop_back();
            for (int e = 0; e < 3; ++e) {
                const Neighbour& beyond = surface.neighbour(t, e);
                if (beyond.triangle < 0 || patch[static_cast<std::size_t>(beyond.triangle)] >= 0) continue;
                if (beyond.flips || turn_of(surface, t, beyond) > edge_angle) continue;
                patch[static_cast<std::size_t>(beyond.triangle)] = count;
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
    add_corner_normals(surface, edge_angle, *shape);
    add_edges(surface, edge_angle, *shape);
    shape->sides = find_sides(surface, edge_angle, look);
    return shape;
}

}  // namespace grainreel
