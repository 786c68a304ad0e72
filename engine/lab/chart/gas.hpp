// Equal smooth grains in a cube of walls, without gravity: from a lattice with random velocities to a gas.
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
    double solid_fraction = 0.05;  // of what their centres can reach
    double speed = 0.3;            // m/s, of each component at first, root mean square
    std::uint64_t seed = 1;

    int count() const { return side * side * side; }
    double free() const;  // m: centres can be anywhere in a cube of this edge
    double edge() const { return free() + 2 * bench_radius; }
};

// Grains are bench_radius and bench_density. The world is started.
struct Gas {
    GasInCube cube;
    SmallWorld world;

    Gas(const Plan& plan, const GasInCube& cube);
    double temperature() const;  // m2/s2
    double energy() const;       // J, of motion and in springs
    void run_to(double seconds);
};

// What the energy of a gas of smooth grains makes of the step's errors: it must stay where impacts are
// elastic, and fall by what they lose where they nearly are.

// 216 grains, a tenth of the space solid, between walls of their own restitution.
struct GasSetting {
    std::string name, law = "walton-braun";
    std::vector<std::string> sets = {};  // further keys of its scene ("run.integrator=gear")
    // The contact corrections, or not, whatever the plan takes.
    enum class Corrected { as_planned, no, yes } corrected = Corrected::as_planned;
    double forces_a_contact = 0;  // 0: as planned
};
Plan gas_plan(const GasSetting& setting, double restitution);

struct GasEnergy {
    std::int64_t steps = 0;
    // Over the energy at first. `gained`: by the errors of the step, so what the gas has more than it should
    // after what latching and dashpots took, which is `lost`.
    double gained = 0, lost = 0;
};
// At rising times, counted in contacts: pi sqrt(m_eff / K) of the linear spring. Empty when goes_on(), asked
// a few times a second, says no.
std::vector<GasEnergy> gas_energy(const Plan& plan, std::uint64_t seed, const std::vector<double>& times,
                                  const std::function<bool()>& goes_on);

// What becomes of the energy of elastic and of nearly elastic gases: a picture of `grainreel chart accuracy`.

// One row a method, restitution, seed and time. False when the watcher stopped it.
bool run_gas_drift(bool quick, ResultTable& table, ChartWork& work);
std::size_t gas_drift_pieces(bool quick);

// Commands for gnuplot that draw gas.csv into `gas`, svg or png by the variable `form`.
const char* gas_drift_drawing();

}  // namespace grainreel
