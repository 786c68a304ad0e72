// A gas of smooth inelastic grains that cools by its collisions (Haff 1983, J. Fluid Mech. 134, 401).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/plan/plan.hpp"

namespace grainreel {

struct CoolingGas {
    double restitution = 0.9;
    double solid_fraction = 0.05;
    int side = 9;            // cube root of the number of grains
    double stiffness = 1e4;  // N/m, of 4 mm grains of 2,500 kg/m3
    std::uint64_t seed = 1;
    Precision precision = Precision::full;
};

// Temperatures T divided by the first one, at these rising times. Times are in units of Haff's tau, from the
// moment when the lattice has become a gas.
std::vector<double> cool(const CoolingGas& gas, const std::vector<double>& times);

// Haff's law: T / T0 = 1 / (1 + t/tau)^2.
double haff(double time);

}  // namespace grainreel
