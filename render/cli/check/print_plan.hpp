// What `grainreel check` prints.
#pragma once

#include <ostream>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The plan of a scene in words: what is modelled and what is left out, how it will be computed, what will
// come out of it and what it will cost. Ends with the plan's warnings and the film's.
void print_plan(const Scene& scene, const Plan& plan, std::ostream& out);

}  // namespace grainreel
