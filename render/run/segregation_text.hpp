// How far a run has separated its species, in one line.
#pragma once

#include <string>

#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Of a scene with two species or more. Indices that are not defined for it are left out; empty without any.
std::string segregation_text(const Scene& scene, const Measures& from, const Measures& to);

}  // namespace grainreel
