// Meshes for worlds that are put together by hand.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/state/drive_motion.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {

// A patch of surface: place(u, v) for u and v from 0 to 1, in `along` x `across` squares of two triangles.
inline void add_sheet(int along, int across, const std::function<Vec3(double, double)>& place,
                      TriangleMesh& mesh) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int a = 0; a <= along; ++a)
        for (int b = 0; b <= across; ++b)
            mesh.vertices.push_back(place(static_cast<double>(a) / along, static_cast<double>(b) / across));
    const auto at = [&](int a, int b) { return first + a * (across + 1) + b; };
    for (int a = 0; a < along; ++a)
        for (int b = 0; b < across; ++b) {
            mesh.triangles.push_back({at(a, b), at(a + 1, b), at(a + 1, b + 1)});
            mesh.triangles.push_back({at(a, b), at(a + 1, b + 1), at(a, b + 1)});
        }
}

// A square in z = 0 with its middle at the origin, facing up, of 2 n^2 triangles.
inline TriangleMesh square_mesh(double side, int n) {
    TriangleMesh mesh;
    add_sheet(
        n, n, [&](double u, double v) { return Vec3((u - 0.5) * side, (v - 0.5) * side, 0); }, mesh);
    return mesh;
}

// A tube about the z axis, from -length / 2 to length / 2. The corners of its facets lie on the circle.
inline TriangleMesh tube_mesh(double radius, double length, int facets, int rings) {
    TriangleMesh mesh;
    add_sheet(
        facets, rings,
        [&](double u, double v) {
            const double angle = 2 * std::numbers::pi * u;
            return Vec3(radius * std::cos(angle), radius * std::sin(angle), (v - 0.5) * length);
        },
        mesh);
    return mesh;
}

// Two half-planes that meet in the x axis and rise from it by these angles (rad) on either side.
inline TriangleMesh groove_mesh(double size, double left, double right, int n = 1) {
    TriangleMesh mesh;
    add_sheet(
        n, n,
        [&](double u, double v) {
            return Vec3((v - 0.5) * size, -u * size * std::cos(left), u * size * std::sin(left));
        },
        mesh);
    add_sheet(
        n, n,
        [&](double u, double v) {
            return Vec3((u - 0.5) * size, v * size * std::cos(right), v * size * std::sin(right));
        },
        mesh);
    return mesh;
}

// The sides of a pyramid with its tip at the origin, pointing up.
inline TriangleMesh cone_mesh(double radius, double height, int sides) {
    TriangleMesh mesh;
    mesh.vertices.push_back(Vec3(0, 0, 0));
    for (int s = 0; s < sides; ++s) {
        const double angle = 2 * std::numbers::pi * s / sides;
        mesh.vertices.push_back(Vec3(radius * std::cos(angle), radius * std::sin(angle), -height));
        mesh.triangles.push_back({0, s + 1, (s + 1) % sides + 1});
    }
    return mesh;
}

// A closed box, each side of 2 n^2 triangles.
inline TriangleMesh box_mesh(const Vec3& low, const Vec3& high, int n) {
    TriangleMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true})
            add_sheet(
                n, n,
                [&](double u, double v) {
                    Vec3 at = upper ? high : low;
                    at[(axis + 1) % 3] = low[(axis + 1) % 3] + u * (high - low)[(axis + 1) % 3];
                    at[(axis + 2) % 3] = low[(axis + 2) % 3] + v * (high - low)[(axis + 2) % 3];
                    return at;
                },
                mesh);
    return mesh;
}

inline std::shared_ptr<const Surface> surface_of(TriangleMesh mesh) {
    MeshFacts facts;
    mend(mesh, facts);
    return std::make_shared<Surface>(std::move(mesh), facts, "by hand");
}

// Lets time pass for bodies with motions of their own.
inline void start_clock(HandMadeBed& w) {
    w.around.motion = DriveMotion(Drive{}, w.plan.clock);
}

// Adds a mesh with the contact of walls.
inline MeshWall& add_mesh(HandMadeBed& w, const std::string& name, TriangleMesh mesh) {
    MeshWall wall;
    wall.name = name;
    wall.surface = surface_of(std::move(mesh));
    wall.body.number = kFirstPlaneBody + static_cast<std::int32_t>(w.around.meshes.size());
    w.around.meshes.push_back(wall);
    w.plan.mesh.push_back(w.plan.wall[0]);
    start_clock(w);
    return w.around.meshes.back();
}

inline BodyTurn turn_about(const Vec3& axis, double rate, const Vec3& through = Vec3(0, 0, 0)) {
    BodyTurn turn;
    turn.axis = axis;
    turn.through = through;
    turn.rate = rate;
    return turn;
}

}  // namespace grainreel
