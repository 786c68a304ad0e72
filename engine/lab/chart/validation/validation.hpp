// `grainreel chart validation`: the engine against published experiments and laws. Each part keeps its own
// tables in the folder: what we measure, and beside it what is published.
#pragma once

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

bool run_validation(const ChartRequest& request, const ChartWatcher& watcher);
std::string validation_drawing();

// One comparison. False when the watcher stopped it.
struct ValidationPart {
    std::size_t (*pieces)(bool quick);
    bool (*run)(const ChartRequest& request, ChartWork& work);
};
extern const ValidationPart impact_part, packing_part, silo_part, gas_part;

}  // namespace grainreel
