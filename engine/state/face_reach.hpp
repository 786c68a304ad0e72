// How far faces reach from the axis about which their body turns.
#pragma once

#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

// Sets Face::reach of a container's faces, where it turns. Walls that go on upwards without end count up to
// twice the height.
void set_reach(const Container& container, std::vector<Face>& faces);

}  // namespace grainreel
