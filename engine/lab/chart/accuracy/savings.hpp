// `grainreel chart savings`: what a scene saves that does without friction, moving walls, a second species
// and the like. One table, savings.csv: cost of a grain's step with and without.
#pragma once

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

bool run_savings(const ChartRequest& request, const ChartWatcher& watcher);
std::string savings_drawing();

}  // namespace grainreel
