// How far a run will be off in the restitution of a free impact, found by making the impact.
#pragma once

#include <string>
#include <vector>

#include "engine/plan/plan.hpp"

namespace grainreel {

// Head-on, at the plan's step and impact speed, as the step loop computes it: the law with its own parameters
// (whether its dashpot may pull, its precision, its corrections), the integrator, the smallest grains of the
// two species, which have the fewest steps in a contact. The largest |e_measured - e| over the
// phases of the first touch; e is what the law gives exactly at this mass and speed. b: nullptr for a wall.
// NaN where fewer than two steps fall into a contact, or more than 1000, which would take long to try.
double promised_restitution_error(const Plan& plan, const PairPlan& pair, const Species& a, const Species* b);

// The phases of the first touch, shares of a step, that are tried. Those next to 0 and 1 count: where a
// contact lasts a whole number of steps, its two ends err together but there.
std::vector<double> promised_onsets();

// In words: to two digits, rounded up, so that the worst phase keeps the promise; "-" for NaN.
std::string promised_error_text(double error);

}  // namespace grainreel
