// What one contact makes of itself at a finite step: the experiments behind `grainreel chart accuracy`.
#pragma once

#include <string>
#include <vector>

#include "engine/plan/plan.hpp"

namespace grainreel {

// How a contact is computed.
struct Method {
    std::string name;
    Integrator integrator = Integrator::velocity_verlet;
    NormalForce normal = NormalForce::walton_braun;
    TangentialLaw tangential = TangentialLaw::incremental_slip;
    Precision precision = Precision::full;

    int forces_a_step() const;
};

// Two equal spheres head-on at one speed, the step a contact's time over `steps` (any number), over evenly
// spread phases of the first touch.
struct NormalErrors {
    double restitution = 0;   // largest |e_measured - e|
    double contact_time = 0;  // largest, over the contact's time
};
NormalErrors normal_errors(const Method& method, double restitution, double steps, int phases);

// A sphere on a plane at angles of incidence from 0 to 85 degrees (friction 0.3, the tangential ratio that
// suits the law), against the same with 4,000 steps: largest error of the tangential velocity and of
// radius x spin, over the speed.
struct ObliqueErrors {
    double velocity = 0, spin = 0;
};
ObliqueErrors oblique_errors(const Method& method, double restitution, double steps);

// A sphere that rests on an elastic plane and is pushed down and sideways, so that it swings both ways
// without sliding: largest error of its tangential velocity within three contact times, over the push,
// against the same with 20,000 steps a contact.
double shear_error(const Method& method, double steps);

// A ball that bounces `bounces` times on an elastic floor, under a gravity that makes each flight last about
// twenty contacts: the largest change of its energy, over the energy, from eight heights. (What one bounce
// gains or loses depends on the phase of the touch, so one height alone says little.)
double bounce_drift(const Method& method, double steps, int bounces);

// ns of one thread that a touching contact costs a force evaluation: 8,000 spheres in a cubic lattice, each
// touching six.
double cost_of_a_contact(const Method& method);

// How far a run will be off in the restitution of a free impact, found by making the impact.

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
