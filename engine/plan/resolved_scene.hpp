// The scene with the plan's choices filled in: scene.toml in the run's folder.
#pragma once

#include <string>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

// Returns the scene with what the plan chose: the stiffness of every kind of contact, the step, and how
// often frames and measures come.
Scene with_choices(Scene scene, const Plan& plan);
// Why the plan chose the values that the scene does not give itself.
Reasons reasons_of(const Scene& scene, const Plan& plan);

// The scene with choices and reasons, as a scene file. In a folder that has the kept files of the meshes,
// read_scene gives the same Scene back bit by bit, with the plan's choices filled in, and make_plan then
// gives the same Plan.
std::string resolved_scene(const Scene& scene, const Plan& plan);

}  // namespace grainreel
