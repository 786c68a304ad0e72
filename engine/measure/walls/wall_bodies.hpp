// The walls of a scene, the bodies to which they belong, and the bodies that turn. This header does not need
// the step loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// A wall, numbered as in the sums of walls: faces first, then meshes.
struct WallBody {
    std::size_t body = 0;  // number of its body; for a tray, that of the container
    bool mesh = false;     // true for a mesh, false for a face
    bool fixed = true;     // whether it stays where it is, apart from the drive's motion of a face
    bool turns = false;    // whether it turns about `axis`, through `point`
    Vec3 point{0, 0, 0};   // m, point about which its moments are taken, given for the wall at rest
    Vec3 axis{0, 0, 0};    // unit
};
std::vector<WallBody> wall_bodies(const Scene& scene);

// Number of the mesh that is the scene's container; empty if there is none.
std::optional<std::size_t> vessel_of(const Scene& scene);

// Whether the container turns about an axis that is not vertical, so that left, right and floor mean nothing.
bool turns_over(const Scene& scene);

// The point (m) about which the moment of the grains on a mesh is taken, given for the mesh at rest. It moves
// with the mesh.
Vec3 moment_point(const SceneMesh& mesh);

// A body that turns about an axis.
struct TurningBody {
    std::int32_t body = 0;  // its number as a body
    BodyTurn turn;
    double radius = 0;  // m, distance of its farthest point from the axis
};

// The body that turns the grains: the container, else the mesh that is the container, else the first mesh
// that turns. Empty if nothing turns.
std::optional<TurningBody> turning_body(const Scene& scene);

}  // namespace grainreel
