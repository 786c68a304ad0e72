// Makes the surroundings that a scene gives its grains: walls and their motion, gravity, the reach of the
// neighbour lists. engine/step/surroundings.hpp says what surroundings are.
#pragma once

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

Surroundings make_surroundings(const Scene& scene, const Plan& plan);

// Opens the outlet of a scene that has one. From then on, grains that have fallen deep enough leave.
void open_outlet(const Scene& scene, Surroundings& around);

}  // namespace grainreel
