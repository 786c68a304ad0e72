// `grainreel chart accuracy`: error against cost, one factor at a time. Four tables, each row a result:
// contacts.csv (single contacts), convergence.csv (tangential laws), gas.csv (elastic and nearly elastic
// gases) and bed.csv (the small bed, every setting with every seed).
#pragma once

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

bool run_accuracy(const ChartRequest& request, const ChartWatcher& watcher);
std::string accuracy_drawing();

}  // namespace grainreel
