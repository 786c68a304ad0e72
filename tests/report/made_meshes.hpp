// Meshes by formula, for tests.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel::test {

// Adds two triangles. The normal is (b - a) x (d - a), where a, b, c, d go round.
inline void add_quad(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& corner : {a, b, c, d}) mesh.vertices.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

// Adds a box with its normals outwards; m.
inline void add_box(TriangleMesh& mesh, const Vec3& low, const Vec3& high) {
    const auto at = [&](int x, int y, int z) {
        return Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
    };
    add_quad(mesh, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    add_quad(mesh, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    add_quad(mesh, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    add_quad(mesh, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    add_quad(mesh, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    add_quad(mesh, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
}

// The mantle of a cylinder about the x axis, open at both ends, with normals outwards.
inline TriangleMesh tube(int facets, double radius, double length) {
    TriangleMesh mesh;
    for (int k = 0; k < facets; ++k) {
        const auto at = [&](int step, double x) {
            const double angle = 2 * std::numbers::pi * step / facets;
            return Vec3(x, radius * std::cos(angle), radius * std::sin(angle));
        };
        add_quad(mesh, at(k, 0), at(k + 1, 0), at(k + 1, length), at(k, length));
    }
    for (TriangleMesh::Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
        const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        if (normal.dot(Vec3(0, corner(0).y(), corner(0).z())) < 0) std::swap(t[1], t[2]);
    }
    return mesh;
}

inline std::shared_ptr<const Surface> surface_of(TriangleMesh mesh) {
    MeshFacts facts;
    facts.read = static_cast<std::int64_t>(mesh.triangles.size());
    mend(mesh, facts);
    return std::make_shared<const Surface>(std::move(mesh), std::move(facts), "by hand");
}

}  // namespace grainreel::test
