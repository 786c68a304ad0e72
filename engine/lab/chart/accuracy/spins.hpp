// How far oblique impacts are off at the step that the plan chooses: tangential velocity and spin, for each
// contact law. It is a table of `grainreel chart accuracy`.
#pragma once

#include <string>
#include <vector>

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

// A contact law as a scene says it.
struct PlannedLaw {
    std::string name;
    std::string lines;  // of [contact]
};
// All that have a tangential spring.
const std::vector<PlannedLaw>& planned_laws();

// Errors of a ball of 4 mm that meets a wall at 0.3 m/s with friction 0.5, against the same impact in steps a
// hundred times shorter: the largest over the phases of the first touch.
struct PlannedErrors {
    double steps = 0;     // in a contact
    double velocity = 0;  // of the tangential velocity, divided by the speed
    double spin = 0;      // divided by the spin
    double normal = 0;    // of the normal velocity, divided by that before
    double formula = 0;   // of the tangential velocity from that of a ball that slides all the time, in the
                          // fine steps, divided by the speed; NaN where it does not slide all the time
};
PlannedErrors planned_errors(const PlannedLaw& law, double restitution, double degrees, int phases);

// Adds one row for each law, restitution and angle. False when the watcher stopped it.
bool run_spins(bool quick, ResultTable& table, ChartWork& work);
std::size_t spin_pieces(bool quick);

// Commands for gnuplot that draw spins.csv into `spins`, as svg or png by the variable `form`.
const char* spins_drawing();

}  // namespace grainreel
