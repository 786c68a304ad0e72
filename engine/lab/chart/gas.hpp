// Equal smooth grains in a cube of walls, without gravity: from a lattice with random velocities to a gas.
#pragma once

#include <cstdint>

#include "engine/lab/chart/bench.hpp"

namespace grainreel {

struct GasInCube {
    int side = 9;                  // cube root of the number of grains
    double solid_fraction = 0.05;  // of what their centres can reach
    double speed = 0.3;            // m/s, of each component at first, root mean square
    std::uint64_t seed = 1;

    int count() const { return side * side * side; }
    double free() const;  // m: centres can be anywhere in a cube of this edge
    double edge() const { return free() + 2 * bench_radius; }
};

// Grains are bench_radius and bench_density. The bench is started.
struct Gas {
    GasInCube cube;
    Bench bench;

    Gas(const Plan& plan, const GasInCube& cube);
    double temperature() const;  // m2/s2
    double energy() const;       // J, of motion and in springs
    void run_to(double seconds);
};

}  // namespace grainreel
