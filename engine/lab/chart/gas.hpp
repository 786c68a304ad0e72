// A gas of equal smooth grains in a cube of walls, without gravity. The grains start on a lattice with random
// velocities.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

struct GasInCube {
    int side = 9;                  // cube root of the number of grains
    double solid_fraction = 0.05;  // volume of the grains as a share of that which their centres can reach
    double speed = 0.3;            // m/s, root mean square of each component at the start
    std::uint64_t seed = 1;

    int count() const { return side * side * side; }
    double free() const;  // m, edge of the cube in which centres can be
    double edge() const { return free() + 2 * bench_radius; }
};

// The gas as a small world, ready to run. Grains have bench_radius and bench_density.
struct Gas {
    GasInCube cube;
    SmallWorld world;

    Gas(const Plan& plan, const GasInCube& cube);
    double temperature() const;  // m2/s2
    double energy() const;       // J, kinetic and in springs
    void run_to(double seconds);
};

// How errors of the step change the energy of a gas of smooth grains. With elastic impacts the energy must
// stay constant; with nearly elastic ones it must fall by what the impacts lose.

// A gas of 216 grains; a tenth of the space is solid, and the walls have the same restitution.
struct GasSetting {
    std::string name, law = "walton-braun";
    std::vector<std::string> sets = {};  // further keys of its scene ("run.integrator=gear")
    // Whether contacts have the contact corrections.
    enum class Corrected { as_planned, no, yes } corrected = Corrected::as_planned;
    double forces_a_contact = 0;  // 0: as planned
};
Plan gas_plan(const GasSetting& setting, double restitution);

struct GasEnergy {
    std::int64_t steps = 0;
    // Shares of the initial energy. `lost` is what latching (plastic unloading) and dashpots took. `gained`
    // is the energy at this time minus (1 - lost): the error of the step.
    double gained = 0, lost = 0;
};
// The energy at these rising times, which are counted in contact times pi sqrt(m_eff / K) of the linear
// spring. Empty when goes_on(), asked every 2000 steps, returned false.
std::vector<GasEnergy> gas_energy(const Plan& plan, std::uint64_t seed, const std::vector<double>& times,
                                  const std::function<bool()>& goes_on);

// How the energy of elastic and of nearly elastic gases drifts: a picture of `grainreel chart accuracy`.

// Adds one row for each method, restitution, seed and time. False when the watcher stopped it.
bool run_gas_drift(bool quick, ResultTable& table, ChartWork& work);
std::size_t gas_drift_pieces(bool quick);

// Commands for gnuplot that draw gas.csv into `gas`, as svg or png by the variable `form`.
const char* gas_drift_drawing();

}  // namespace grainreel
