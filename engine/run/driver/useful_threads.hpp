// How many threads a run is worth.
#pragma once

#include <cstdint>

#include "engine/scene/scene.hpp"

namespace grainreel {

// How many of these processors to use. A thread with too few grains waits longer than it works.
int useful_threads(int processors, std::int64_t grains);

// How many threads a run takes that has the processors for itself: those that the scene grants it, or all
// that this process may use.
int engine_threads(const Scene& scene);

}  // namespace grainreel
