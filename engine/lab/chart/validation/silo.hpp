// A column of grains in a cylinder: how much of their weight reaches the floor (Janssen 1895).
//
// The grains fall from random places and come to rest. Then the floor sinks slowly by half a diameter, so
// that they slide down the wall and its friction points upwards everywhere (as in Vanel & Clement 1999, Eur.
// Phys. J. B 11, 525). Forces on floor and wall are means over the second half of this motion.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/plan/plan.hpp"

namespace grainreel {

struct SiloColumn {
    double bore = 10;            // diameter of the cylinder divided by that of the grains
    double aspect = 2;           // height of the filling divided by the bore, for a solid fraction of 0.58
    double friction = 0.5;       // among grains
    double wall_friction = 0.2;  // lower, so that grains slide down the wall instead of rolling
    std::uint64_t seed = 1;
    Precision precision = Precision::full;
};

// The chart fills it from the columns of silo.csv in this order.
struct SiloLoad {
    double filling = 0;   // mass of the grains, in units of rho_b pi D^3 / 4, a column as high as the bore D
    double apparent = 0;  // mass that the floor carries, in the same unit
    double solid_fraction = 0;
    double stress_ratio =
        0;                 // K: mean pressure on the wall divided by the mean vertical stress in the grains
    double mobilised = 0;  // upward friction of the wall divided by friction coefficient times pressure
    double resting = 0;    // like `apparent`, but before the floor sinks
};
SiloLoad load_of(const SiloColumn& column);

// Janssen's law: the apparent mass of a filling, both in the unit of SiloLoad. It saturates at 1 / (4 mu K).
double janssen(double filling, double friction_times_ratio);

// The mu K that fits best (least squares), and the rms of the residuals divided by the saturation mass.
struct JanssenFit {
    double friction_times_ratio = 0, residual = 0;
};
JanssenFit fit_janssen(const std::vector<SiloLoad>& loads);

}  // namespace grainreel
