// Meshes with closed forms, for tests.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel::shapes {

inline void add_triangle(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
}

inline void add_quad(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

inline void add(TriangleMesh& mesh, const TriangleMesh& other) {
    for (const TriangleMesh::Triangle& t : other.triangles)
        add_triangle(mesh, other.vertices[static_cast<std::size_t>(t[0])],
                     other.vertices[static_cast<std::size_t>(t[1])],
                     other.vertices[static_cast<std::size_t>(t[2])]);
}

// Turns all triangles round.
inline TriangleMesh inside_out(TriangleMesh mesh) {
    for (TriangleMesh::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

// Outwards; without a lid it is open above.
inline TriangleMesh box(const Vec3& low, const Vec3& high, bool lid = true) {
    const auto at = [&](int i) {
        return Vec3((i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z());
    };
    TriangleMesh mesh;
    add_quad(mesh, at(0), at(2), at(3), at(1));
    add_quad(mesh, at(0), at(1), at(5), at(4));
    add_quad(mesh, at(1), at(3), at(7), at(5));
    add_quad(mesh, at(3), at(2), at(6), at(7));
    add_quad(mesh, at(2), at(0), at(4), at(6));
    if (lid) add_quad(mesh, at(4), at(5), at(7), at(6));
    return mesh;
}

// A wall of `sides` around z through rings (radius, height) from the lowest one on, outwards; a ring of
// radius 0 is a tip. The ends are closed by fans where they are asked for.
struct Ring {
    double radius, z;
};
inline TriangleMesh turned(const std::vector<Ring>& rings, int sides, bool floor, bool lid) {
    const auto at = [&](const Ring& ring, int i) {
        const double angle = 2 * std::numbers::pi * (i % sides) / sides;
        return Vec3(ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z);
    };
    TriangleMesh mesh;
    for (int i = 0; i < sides; ++i) {
        for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
            const Ring &low = rings[k], &high = rings[k + 1];
            if (low.radius > 0) add_triangle(mesh, at(low, i), at(low, i + 1), at(high, i + 1));
            if (high.radius > 0) add_triangle(mesh, at(low, i), at(high, i + 1), at(high, i));
        }
        if (floor)
            add_triangle(mesh, Vec3(0, 0, rings.front().z), at(rings.front(), i + 1), at(rings.front(), i));
        if (lid) add_triangle(mesh, Vec3(0, 0, rings.back().z), at(rings.back(), i), at(rings.back(), i + 1));
    }
    return mesh;
}

// m2, of a regular polygon.
inline double polygon(double radius, int sides) {
    return 0.5 * sides * radius * radius * std::sin(2 * std::numbers::pi / sides);
}
// m3, of a frustum between two polygons.
inline double frustum(double low, double high, double height, int sides) {
    return height / 3 *
           (polygon(low, sides) + polygon(high, sides) +
            std::sqrt(polygon(low, sides) * polygon(high, sides)));
}

// A sheet over [-half, half]^2 of n x n squares, each cut in two; height(x, y).
template <class Height>
TriangleMesh sheet(double half, int n, Height&& height) {
    TriangleMesh mesh;
    const auto at = [&](int i, int j) {
        const double x = half * (2.0 * i / n - 1), y = half * (2.0 * j / n - 1);
        return Vec3(x, y, height(x, y));
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return mesh;
}

inline std::shared_ptr<const Surface> mended(TriangleMesh mesh) {
    MeshFacts facts;
    mend(mesh, facts);
    return std::make_shared<const Surface>(std::move(mesh), facts, "a test");
}

}  // namespace grainreel::shapes
