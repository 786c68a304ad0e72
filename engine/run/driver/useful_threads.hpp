// How many threads a run is worth.
#pragma once

#include <cstdint>

#include "engine/scene/scene.hpp"

namespace grainreel {

// Of so many processors. A thread with too few grains waits longer than it works.
int useful_threads(int processors, std::int64_t grains);

// Of a run that has the processors for itself: those that the scene grants it, or all that this process may
// use.
int engine_threads(const Scene& scene);

}  // namespace grainreel
