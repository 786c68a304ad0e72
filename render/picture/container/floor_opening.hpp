// A floor with a round hole, as flat pieces that are convex each.
#pragma once

#include <vector>

#include "engine/base/vector.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The container as it is at a time (s): without its outlet as long as that is closed.
Container container_at(const Container& container, double time);

// Points around the hole, at a height; m.
std::vector<Vec3> rim_of_hole(const Outlet& outlet, double height);

// What is left of a disc, or of a rectangle with corners (+-half_depth, +-half_width), around the hole.
using Pieces = std::vector<std::vector<Vec3>>;
Pieces disc_around_hole(const Outlet& outlet, double radius, double height);
Pieces rectangle_around_hole(const Outlet& outlet, double half_depth, double half_width, double height);

}  // namespace grainreel
