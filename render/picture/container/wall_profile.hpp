// The cross-section of a wedge's or a box's side wall, as it is drawn.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// From the floor up: the inner line, and the outer one a wall's thickness away; (y, z) in m, as many points
// each.
struct WallProfile {
    std::vector<Eigen::Vector2d> inner, outer;
};

// side: +1 for the wall at y > 0, -1 for the other.
WallProfile wall_profile(const Container& container, double side);

}  // namespace grainreel
