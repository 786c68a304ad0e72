// The walls of a scene, the bodies that they belong to, and which of these turn. Needs no step loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// A wall as its sums are numbered: faces first, then meshes.
struct WallBody {
    std::size_t body = 0;  // its number; of a tray that of the container
    bool mesh = false;     // a mesh, or a face
    bool fixed = true;     // whether it stays where it is, but for the drive's motion of a face
    bool turns = false;    // about `axis`, through `point`
    Vec3 point{0, 0, 0};   // m, at rest: what its sums of moments are about
    Vec3 axis{0, 0, 0};    // unit
};
std::vector<WallBody> wall_bodies(const Scene& scene);

// Which of the scene's meshes is the container; empty where none is.
std::optional<std::size_t> vessel_of(const Scene& scene);

// Whether the container turns about an axis that does not stand, so that left, right and floor mean nothing.
bool turns_over(const Scene& scene);

// m, at rest: the moment of the grains on a mesh counts about it. It moves with the mesh.
Vec3 moment_point(const SceneMesh& mesh);

// A body that turns about an axis.
struct TurningBody {
    std::int32_t body = 0;  // its number
    BodyTurn turn;
    double radius = 0;  // m, of its farthest point from the axis
};

// What the grains are turned by: the container, else the mesh that is the container, else the first mesh that
// turns. Empty where nothing turns.
std::optional<TurningBody> turning_body(const Scene& scene);

}  // namespace grainreel
