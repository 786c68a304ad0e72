// Contacts with walls of which some end at edges, as those of a container with an open outlet do. Scenes
// without such walls take the way of touch_walls() in wall_geometry.cpp, which calls these where they are
// needed.
#pragma once

#include "engine/step/geometry/contact_geometry.hpp"

namespace grainreel {

// As touching_walls() and touch_walls().
std::uint64_t touching_plates(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                              int count, const WallState& walls);
void touch_plates(const GeometryInput& in, const WallState& walls, TouchChunk& out);

}  // namespace grainreel
