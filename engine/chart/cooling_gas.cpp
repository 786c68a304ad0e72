#include "engine/chart/cooling_gas.hpp"

#include <cmath>

#include "engine/base/random.hpp"
#include "engine/chart/bench.hpp"
#include "engine/measure/energy.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

constexpr double radius = bench_radius, density = bench_density, diameter = 2 * radius;
constexpr double speed = 0.3;  // m/s, of each component at first

PairPlan smooth_pair(const CoolingGas& gas, double restitution) {
    PairPlan pair = latching_pair(gas.stiffness, restitution, 0, gas.precision);
    pair.model.normal = NormalForce::walton_braun_corrected;
    return pair;
}

struct Gas {
    int count;
    double mass;  // kg, of a grain
    double free;  // m: centres can be anywhere in a cube of this edge, and that is the gas's volume
    Bench bench;

    explicit Gas(const CoolingGas& gas)
        : count(gas.side * gas.side * gas.side),
          mass(density * sphere_volume(radius)),
          free(std::cbrt(count * sphere_volume(radius) / gas.solid_fraction)),
          bench(smooth_pair(gas, gas.restitution),
                pi / 2 * (1 + gas.restitution) * std::sqrt(mass / 2 / gas.stiffness) / 14) {
        bench.plan.wall = {smooth_pair(gas, 1)};  // elastic
        const double edge = free + diameter;
        for (int axis = 0; axis < 3; ++axis) {
            bench.add_plane(Vec3(0, 0, 0), Vec3::Unit(axis));
            bench.add_plane(edge * Vec3::Unit(axis), -Vec3::Unit(axis));
        }
        Random random(gas.seed, Stream::velocities);
        for (int k = 0; k < count; ++k) {
            const Vec3 cell(k % gas.side, k / gas.side % gas.side, k / gas.side / gas.side);
            const double u = random.normal(), v = random.normal(), w = random.normal();
            bench.add((cell + 0.5 * Vec3::Ones()) * edge / gas.side, speed * Vec3(u, v, w),
                      {radius, density});
        }
        bench.around.skin = 0.5 * radius;
        bench.start();
    }
    double temperature() const {  // m2/s2
        return 2.0 / 3 * kinetic_energy(bench.grains).translation / (count * mass);
    }
    std::int64_t steps(double seconds) const {
        return static_cast<std::int64_t>(seconds / bench.plan.clock.step);
    }
};

// s: 1/tau = w0 (1 - e^2) / 6 with Enskog's collision rate w = 4 sqrt(pi) n d^2 g sqrt(T/m), of which each
// takes (1 - e^2) T; g after Carnahan & Starling.
double haff_time(const CoolingGas& setting, const Gas& gas) {
    const double solid = setting.solid_fraction, e = setting.restitution;
    const double g = (1 - solid / 2) / std::pow(1 - solid, 3);
    // Two centres a diameter apart have less room than one: the mean of (1 - d|u_x|/L)(1 - d|u_y|/L)(..).
    const double near_walls = 1 - 1.5 * diameter / gas.free;
    const double number_density = gas.count / std::pow(gas.free, 3);
    const double rate = 4 * std::sqrt(pi) * number_density * diameter * diameter * g * near_walls *
                        std::sqrt(gas.temperature());
    return 6 / (rate * (1 - e * e));
}

}  // namespace

std::vector<double> cool(const CoolingGas& setting, const std::vector<double>& times) {
    Gas gas(setting);
    gas.bench.run(gas.steps(0.1));  // from the lattice to a gas
    const std::int64_t begin = gas.bench.step;
    const double start = gas.temperature(), tau = haff_time(setting, gas);
    std::vector<double> temperatures;
    for (const double time : times) {
        gas.bench.run(begin + gas.steps(time * tau) - gas.bench.step);
        temperatures.push_back(gas.temperature() / start);
    }
    return temperatures;
}

double haff(double time) {
    return 1 / ((1 + time) * (1 + time));
}

}  // namespace grainreel
