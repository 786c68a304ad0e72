#include "engine/lab/chart/validation/cooling_gas.hpp"

#include <fmt/format.h>
#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/gas.hpp"
#include "engine/lab/chart/validation/validation.hpp"

namespace grainreel {

namespace {

using std::numbers::pi;

PairPlan smooth_pair(const CoolingGas& gas, double restitution) {
    PairPlan pair = latching_pair(gas.stiffness, restitution, 0, gas.precision);
    pair.model.normal = NormalForce::walton_braun_corrected;
    return pair;
}

// A plan with 14 steps a contact and elastic walls.
Plan gas_plan(const CoolingGas& gas) {
    Plan plan;
    plan.grain = {smooth_pair(gas, gas.restitution)};
    plan.wall = {smooth_pair(gas, 1)};
    plan.clock.step = pi / 2 * (1 + gas.restitution) * std::sqrt(bench_mass() / 2 / gas.stiffness) / 14;
    return plan;
}

// Haff's time tau (s): 1/tau = w0 (1 - e^2) / 6, where w0 is Enskog's collision rate at the start, w =
// 4 sqrt(pi) n d^2 g sqrt(T/m), with the g of Carnahan & Starling. A collision takes energy in proportion to
// (1 - e^2) T.
double haff_time(const CoolingGas& setting, const Gas& gas) {
    const double solid = setting.solid_fraction, e = setting.restitution;
    const double g = (1 - solid / 2) / math::cube(1 - solid);
    // Two centres a diameter d apart have less space than one in a cube of edge L: the share is the mean of
    // (1 - d|u_x|/L)(1 - d|u_y|/L)(1 - d|u_z|/L) over all directions u, here to first order in d / L.
    const double diameter = 2 * bench_radius, free = gas.cube.free();
    const double near_walls = 1 - 1.5 * diameter / free;
    const double number_density = gas.cube.count() / math::cube(free);
    const double rate = 4 * std::sqrt(pi) * number_density * diameter * diameter * g * near_walls *
                        std::sqrt(gas.temperature());
    return 6 / (rate * (1 - e * e));
}

}  // namespace

std::vector<double> cool(const CoolingGas& setting, const std::vector<double>& times) {
    GasInCube cube;
    cube.side = setting.side;
    cube.solid_fraction = setting.solid_fraction;
    cube.seed = setting.seed;
    Gas gas(gas_plan(setting), cube);
    constexpr double mixed = 0.1;  // s, after which the lattice has become a gas
    gas.run_to(mixed);
    const double start = gas.temperature(), tau = haff_time(setting, gas);
    std::vector<double> temperatures;
    for (const double time : times) {
        gas.run_to(mixed + time * tau);
        temperatures.push_back(gas.temperature() / start);
    }
    return temperatures;
}

double haff(double time) {
    return 1 / ((1 + time) * (1 + time));
}

// The comparison of a cooling gas with Haff's law (1983).

namespace {

std::vector<double> times(bool quick) {
    if (quick) return {0.5, 1, 2};
    return {0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 5};
}
const std::vector<double> stiffnesses = {1e4, 1.6e5};  // N/m
int gas_seeds(bool quick) {
    return quick ? 1 : 5;
}

void summarise_gases(const ChartRequest& request, const ResultTable& table) {
    std::string text = "stiffness_N_m,tau,temperature,error,haff,difference_percent\n";
    for (const double stiffness : stiffnesses) {
        for (const double time : times(request.quick)) {
            std::vector<double> values;
            for (const auto& row : table.rows())
                if (row.at(0) == number(stiffness) && row.at(2) == number(time))
                    values.push_back(value_in(row, 3));
            const SeedMean is = seed_mean_of(values);
            text += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:+.1f}\n", number(stiffness), time, is.mean,
                                is.error, haff(time), 100 * (is.mean / haff(time) - 1));
        }
    }
    replace_file(request.folder / "haff.csv", text);
}

bool run_gases(const ChartRequest& request, ChartWork& work) {
    ResultTable table(request.folder / "gas.csv", "stiffness_N_m,seed,tau,temperature", 3);
    for (const double stiffness : stiffnesses) {
        for (int seed = 1; seed <= gas_seeds(request.quick); ++seed) {
            if (!work.next(fmt::format("cooling gas, {:g} N/m, seed {}", stiffness, seed))) return false;
            const std::vector<double> at = times(request.quick);
            if (table.has({number(stiffness), number(seed), number(at.back())})) continue;
            CoolingGas gas;
            gas.stiffness = stiffness;
            gas.seed = static_cast<std::uint64_t>(seed);
            const std::vector<double> is = cool(gas, at);
            for (std::size_t k = 0; k < at.size(); ++k)
                table.add({number(stiffness), number(seed), number(at[k]), number(is[k])});
        }
    }
    summarise_gases(request, table);
    return true;
}

}  // namespace

const ValidationPart gas_part = {
    [](bool quick) { return stiffnesses.size() * static_cast<std::size_t>(gas_seeds(quick)); }, run_gases};

}  // namespace grainreel
