// `grainreel chart validation`: compares the engine with published experiments and laws. Each part writes its
// own tables into the folder: our results, and beside them the published ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

bool run_validation(const ChartRequest& request, const ChartWatcher& watcher);
std::string validation_drawing();

// One comparison. `run` returns false when the watcher stopped it.
struct ValidationPart {
    std::size_t (*pieces)(bool quick);
    bool (*run)(const ChartRequest& request, ChartWork& work);
};
extern const ValidationPart impact_part, packing_part, silo_part, gas_part;

// Mean over a few seeds and its standard error.
struct SeedMean {
    double mean = 0, error = 0;
};
inline SeedMean seed_mean_of(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (const double v : values) mean += v / count;
    for (const double v : values) squares += (v - mean) * (v - mean);
    return {mean, std::sqrt(squares / std::max(1.0, count - 1) / count)};
}

}  // namespace grainreel
