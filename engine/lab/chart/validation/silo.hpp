// A column of grains in a cylinder: what of their weight reaches the floor (Janssen 1895).
//
// The grains come down from a loose crowd and rest; then the floor sinks slowly by half a diameter, so that
// they slide down the wall and its friction points upwards everywhere (as Vanel & Clement 1999, Eur. Phys. J.
// B 11, 525, did it). Floor and wall forces are means over the second half of that way.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/plan/plan.hpp"

namespace grainreel {

struct SiloColumn {
    double bore = 10;       // diameter of the cylinder over that of the grains
    double aspect = 2;      // height of the filling over the bore, as estimated with a solid fraction of 0.58
    double friction = 0.5;  // among grains
    double wall_friction = 0.2;  // lower, so that grains slide down the wall instead of rolling
    std::uint64_t seed = 1;
    Precision precision = Precision::full;
};

struct SiloLoad {
    double filling = 0;   // mass of the grains over rho_b pi D^3 / 4, that of a column one bore high
    double apparent = 0;  // mass that the floor carries, as above
    double solid_fraction = 0;
    double stress_ratio =
        0;                 // K: pressure on the wall over the vertical stress, both averaged over its height
    double mobilised = 0;  // upward friction of the wall over friction times pressure
    double resting = 0;    // as `apparent`, but before the floor sinks
};
SiloLoad load_of(const SiloColumn& column);

// Janssen: apparent mass of a filling, both over that of a column one bore high; it saturates at 1 / (4 mu
// K).
double janssen(double filling, double friction_times_ratio);

// The mu K that fits best (least squares), and the rms of what it leaves over the saturation mass.
struct JanssenFit {
    double friction_times_ratio = 0, residual = 0;
};
JanssenFit fit_janssen(const std::vector<SiloLoad>& loads);

}  // namespace grainreel
