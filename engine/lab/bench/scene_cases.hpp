// Beds of scenes: the default film's hopper, one big grain among small ones, a gas.
#pragma once

#include <vector>

#include "engine/lab/bench/bench_case.hpp"

namespace grainreel {

std::vector<BenchCase> scene_cases();

// The scene of the default film, as far as the engine is concerned.
const char* wedge_scene();

}  // namespace grainreel
