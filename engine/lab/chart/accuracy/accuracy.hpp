// `grainreel chart accuracy`: the error of a run against its cost, when one setting at a time is changed. The
// chart has five tables with one result in each row: contacts.csv (single contacts), convergence.csv
// (tangential laws), spins.csv (oblique impacts as planned), gas.csv (elastic and nearly elastic gases) and
// bed.csv (the small bed, every setting with every seed). Another, differences.csv, is computed from bed.csv.
#pragma once

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

bool run_accuracy(const ChartRequest& request, const ChartWatcher& watcher);
std::string accuracy_drawing();

// How the error of a tangential law falls with the step: a picture of `grainreel chart accuracy`.

// Adds one row for each kind of contact, law and number of steps. False when the watcher stopped it.
bool run_convergence(bool quick, ResultTable& table, ChartWork& work);
std::size_t convergence_pieces(bool quick);

// Commands for gnuplot that draw convergence.csv into `convergence`, as svg or png by the variable `form`.
const char* convergence_drawing();

// Commands for gnuplot that draw the errors of the restitution, of the spin and of the bed against the cost,
// for the laws as planned and for other engines at the steps that they advise, into `speed`.
const char* speed_drawing();

// `grainreel chart savings`: how much time a scene saves if it has no friction, no moving walls, no second
// species and the like. The chart has one table, savings.csv: the cost of a grain's step with and without
// each of these.

bool run_savings(const ChartRequest& request, const ChartWatcher& watcher);
std::string savings_drawing();

}  // namespace grainreel
