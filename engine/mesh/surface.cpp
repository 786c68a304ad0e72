#include "engine/mesh/surface.hpp"

#include <algorithm>
#include <cmath>

#include "engine/mesh/edge_table.hpp"

namespace grainreel {
namespace {

constexpr double flat_angle = 1e-6;  // rad

// The cross product of the two shorter edges keeps most digits where the triangle is slender.
Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const double lab = ab.squaredNorm(), lbc = bc.squaredNorm(), lca = ca.squaredNorm();
    Vec3 normal;
    if (lab >= lbc && lab >= lca)
        normal = bc.cross(ca);
    else if (lbc >= lca)
        normal = ca.cross(ab);
    else
        normal = ab.cross(bc);
    return normal.normalized();
}

}  // namespace

Surface::Surface(TriangleMesh mesh, MeshFacts facts, std::string hash)
    : mesh_(std::move(mesh)), facts_(std::move(facts)), hash_(std::move(hash)) {
    find_normals();
    find_neighbours();
    build_tree();
}

void Surface::find_normals() {
    normals_.resize(mesh_.triangles.size());
    for (std::int32_t t = 0; t < size(); ++t)
        normals_[static_cast<std::size_t>(t)] = normal_of(corner(t, 0), corner(t, 1), corner(t, 2));
}

void Surface::find_neighbours() {
    neighbours_.resize(mesh_.triangles.size());
    const double smooth_cosine = std::cos(kSmoothAngle);
    const auto turn = [&](std::int32_t side, std::int32_t other, bool flips) {
        const std::int32_t here = side / 3, there = other / 3;
        const Vec3& n = normal(here);
        const Vec3 m = flips ? Vec3(-normal(there)) : normal(there);
        const double cosine = n.dot(m);
        if (cosine > 0 && n.cross(m).squaredNorm() < flat_angle * flat_angle) return Neighbour::Turn::flat;
        if (cosine > smooth_cosine) return Neighbour::Turn::smooth;
        const Vec3 beyond = corner(there, (other + 2) % 3) - corner(there, other % 3);
        return n.dot(beyond) > flat_angle * beyond.norm() ? Neighbour::Turn::concave
                                                          : Neighbour::Turn::convex;
    };
    EdgeTable(mesh_).each([&](std::int32_t, std::span<const EdgeSide> sides) {
        if (sides.size() != 2) return;
        const std::int32_t a = sides[0].side, b = sides[1].side;
        const bool flips = begin_of(mesh_, a) == begin_of(mesh_, b);
        neighbours_[static_cast<std::size_t>(a / 3)][static_cast<std::size_t>(a % 3)] = {
            b / 3, turn(a, b, flips), flips};
        neighbours_[static_cast<std::size_t>(b / 3)][static_cast<std::size_t>(b % 3)] = {
            a / 3, turn(b, a, flips), flips};
    });
}

double Surface::area(std::int32_t triangle) const {
    const Vec3& a = corner(triangle, 0);
    return 0.5 * (corner(triangle, 1) - a).cross(corner(triangle, 2) - a).norm();
}

double Surface::farthest_from_axis(const Vec3& through, const Vec3& axis) const {
    const Vec3 unit = axis.normalized();
    double farthest = 0;
    for (const Vec3& vertex : mesh_.vertices) {
        const Vec3 there = vertex - through;
        farthest = std::max(farthest, (there - unit * unit.dot(there)).squaredNorm());
    }
    return std::sqrt(farthest);
}

double Surface::farthest_from(const Vec3& point) const {
    double farthest = 0;
    for (const Vec3& vertex : mesh_.vertices) farthest = std::max(farthest, (vertex - point).squaredNorm());
    return std::sqrt(farthest);
}

}  // namespace grainreel
