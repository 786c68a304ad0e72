// From a Scene back to a scene file: scene.toml in the run's folder.
#pragma once

#include <string>

#include "engine/scene/chapters/reasons.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Every value as resolved, in SI. read_scene gives the same Scene back, bit by bit. Values that have a reason
// get it as a comment.
std::string written_scene(const Scene& scene, const Reasons& reasons = {});

}  // namespace grainreel
