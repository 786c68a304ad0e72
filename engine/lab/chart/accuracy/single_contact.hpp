// How accurate one contact is at a finite step: experiments with single contacts for `grainreel chart
// accuracy`.
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

    // How many times a step evaluates the forces.
    int forces_a_step() const;
};

// Errors of a head-on impact of two equal spheres at one speed. The step is the contact time divided by
// `steps`, which need not be whole. The first touch lies somewhere within a step; its phase, the share of the
// step that is left then, is varied evenly, and the errors are the largest ones.
struct NormalErrors {
    double restitution = 0;   // largest |e_measured - e|
    double contact_time = 0;  // largest error, divided by the contact time
};
NormalErrors normal_errors(const Method& method, double restitution, double steps, int phases);

// Errors of oblique impacts of a sphere on a plane, at angles from 0 to 85 degrees (friction 0.3, the
// tangential ratio that suits the law): the largest errors of the tangential velocity and of radius x spin,
// divided by the speed. The reference is the same impact with 4,000 steps.
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

// Time (ns of one thread) to compute the force of a touching contact once, measured on 8,000 spheres in a
// cubic lattice, each touching six.
double cost_of_a_contact(const Method& method);

// How far the restitution in a run will be from the wanted one, found by trying one impact without gravity.

// The largest |e_measured - e| over the phases of the first touch, where e is what the law gives exactly at
// this mass and speed. The impact is head-on, at the plan's step and impact speed, as the step loop
// computes it: with the integrator, and the law with its own parameters (whether its dashpot may pull, its
// precision, its corrections). It takes the smallest grains of the two species, which have the fewest steps
// in a contact. b is nullptr for a wall. NaN where a contact has fewer than two steps, or more than 1000,
// which would take long to try.
double promised_restitution_error(const Plan& plan, const PairPlan& pair, const Species& a, const Species* b);

// The phases of the first touch that are tried, as shares of a step. They include phases next to 0 and 1,
// because a contact that lasts a whole number of steps has other errors there than elsewhere.
std::vector<double> promised_onsets();

// The error in words: two digits, rounded up, so that no phase is worse than the text says; "-" for NaN.
std::string promised_error_text(double error);

}  // namespace grainreel
