// The walls of a scene as columns of measures and files name them.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

// Container and planes, in the order of the surroundings' faces, then the meshes, as parts of columns:
// "left_slant". Each name once: of walls of one name the second is "NAME_2".
std::vector<std::string> face_names(const Scene& scene);

}  // namespace grainreel
