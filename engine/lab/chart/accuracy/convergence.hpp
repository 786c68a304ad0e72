// How the error of a tangential law falls with the step: a picture of `grainreel chart accuracy`.
#pragma once

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

// One row a kind of contact, law and number of steps. False when the watcher stopped it.
bool run_convergence(bool quick, ResultTable& table, ChartWork& work);
std::size_t convergence_pieces(bool quick);

// Commands for gnuplot that draw convergence.csv into `convergence`, svg or png by the variable `form`.
const char* convergence_drawing();

}  // namespace grainreel
