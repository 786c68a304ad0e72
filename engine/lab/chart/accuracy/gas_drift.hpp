// What becomes of the energy of elastic and of nearly elastic gases: a picture of `grainreel chart accuracy`.
#pragma once

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

// One row a method, restitution, seed and time. False when the watcher stopped it.
bool run_gas_drift(bool quick, ResultTable& table, ChartWork& work);
std::size_t gas_drift_pieces(bool quick);

// Commands for gnuplot that draw gas.csv into `gas`, svg or png by the variable `form`.
const char* gas_drift_drawing();

}  // namespace grainreel
