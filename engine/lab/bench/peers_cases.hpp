// The peers' bed with their law, with ours, and without friction.
#pragma once

#include <vector>

#include "engine/lab/bench/bench_case.hpp"

namespace grainreel {

std::vector<BenchCase> peers_cases();

}  // namespace grainreel
