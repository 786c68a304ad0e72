// From a Scene back to a scene file: scene.toml in the run's folder.
#pragma once

#include <string>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Every value as resolved, in SI, also what the plan chose (stiffness of every pair, step). read_scene gives
// the same Scene back, bit by bit, with the plan's choices filled in; make_plan then gives the same Plan.
std::string resolved_scene(const Scene& scene, const Plan& plan);

}  // namespace grainreel
