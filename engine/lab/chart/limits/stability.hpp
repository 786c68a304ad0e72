// `grainreel chart stability`: where each method fails, measured beside theory. Two tables: limits.csv, a row
// an experiment, and curves.csv, how it comes to that.
#pragma once

#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/limits/experiment.hpp"

namespace grainreel {

// All, in the order of the tables.
std::vector<Experiment> stability_experiments();

bool run_stability(const ChartRequest& request, const ChartWatcher& watcher);
std::string stability_drawing();

}  // namespace grainreel
