// The walls of a scene by the bodies that they belong to.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/base/vector.hpp"
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

}  // namespace grainreel
