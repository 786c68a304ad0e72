// How accurate one contact is at a finite step: the experiments behind `grainreel chart accuracy`.
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

// Errors of a head-on impact of two equal spheres at one speed. The step is the contact time over `steps`
// (any number). The errors are the largest over evenly spread phases of the first touch.
struct NormalErrors {
    double restitution = 0;   // largest |e_measured - e|
    double contact_time = 0;  // largest error, over the contact time
};
NormalErrors normal_errors(const Method& method, double restitution, double steps, int phases);

// Errors of oblique impacts of a sphere on a plane, at angles from 0 to 85 degrees (friction 0.3, the
// tangential ratio that suits the law): the largest errors of the tangential velocity and of radius x spin,
// over the speed. The reference is the same impact with 4,000 steps.
struct ObliqueErrors {
    double velocity = 0, spin = 0;
};
ObliqueErrors oblique_errors(const Method& method, double restitution, double steps);

// Error of a sphere that rests on an elastic plane and is pushed down and sideways, so that it swings both
// ways without sliding. It is the largest error of the tangential velocity within three contact times,
// divided by the speed of the push. `steps` a contact is a multiple of 8. The reference has 20,000.
double shear_error(const Method& method, double steps);

// Energy error of a ball that bounces `bounces` times on an elastic floor, under a gravity that makes each
// flight last about twenty contact times. It is the largest relative change of energy from eight heights.
// (What one bounce gains or loses depends on the phase of the touch, so one height alone says little.)
double bounce_drift(const Method& method, double steps, int bounces);

// Cost (ns of one thread) of a force evaluation of a touching contact, measured on 8,000 spheres in a cubic
// lattice, each touching six.
double cost_of_a_contact(const Method& method);

// How far the restitution of a run will be off, tried by one impact without gravity.

// The largest |e_measured - e| over the phases of the first touch, where e is what the law gives exactly at
// this mass and speed. The impact is head-on, at the plan's step and impact speed, as the step loop
// computes it: with the integrator, and the law with its own parameters (whether its dashpot may pull, its
// precision, its corrections). It takes the smallest grains of the two species, which have the fewest steps
// in a contact. b is nullptr for a wall. NaN where fewer than two steps fall into a contact, or more than
// 1000, which would take long to try.
double promised_restitution_error(const Plan& plan, const PairPlan& pair, const Species& a, const Species* b);

// The phases of the first touch that are tried, as shares of a step. Phases next to 0 and 1 belong to them,
// because a contact that lasts a whole number of steps has other errors there than at all other phases.
std::vector<double> promised_onsets();

// The error in words: two digits, rounded up, so that no phase is worse than the text says; "-" for NaN.
std::string promised_error_text(double error);

}  // namespace grainreel
