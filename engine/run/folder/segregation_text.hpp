// How far a run has separated its species, in one line.
#pragma once

#include <string>

#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// What a scene with two species or more did, in words. to: means over the rows that `over` names. Indices
// that are not defined at the start and then are left out; empty where none is. Where the two that are 1 in a
// mixture disagree, it says so.
std::string segregation_text(const Scene& scene, const Measures& from, const Measures& to,
                             const std::string& over);

}  // namespace grainreel
