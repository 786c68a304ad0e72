#include "engine/lab/chart/accuracy/nearly_elastic_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/lab/chart/gas.hpp"
#include "engine/measure/energy/energy_balance.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/step/motion/scheme.hpp"

namespace grainreel {
namespace {

constexpr double stiffness = 1e4;  // N/m
constexpr int side = 6;

GasInCube cube_of(std::uint64_t seed) {
    GasInCube cube;
    cube.side = side;
    cube.solid_fraction = 0.1;
    cube.seed = seed;
    return cube;
}

// E* of Hertz' contact: k a^(3/2) stores 2/5 k a^(5/2), k = 4/3 E* sqrt(R/2), which at the overlap of 1 %
// that the plan allows is the linear spring's energy.
double modulus() {
    const double overlap = 0.01 * 2 * bench_radius, k = 1.25 * stiffness / std::sqrt(overlap);
    return 0.75 * k / std::sqrt(bench_radius / 2);
}

std::string scene_text(const std::string& law, double restitution) {
    const double edge = cube_of(1).edge();
    const std::string spring = law == "hertz" ? fmt::format("modulus = {:.17g}", modulus())
                                              : fmt::format("stiffness = {:.17g}", stiffness);
    return "gravity = 0\n[[species]]\nname = \"grain\"\n" +
           fmt::format("count = {}\ndiameter = {:.17g}\ndensity = {:.17g}\n", side * side * side,
                       2 * bench_radius, bench_density) +
           fmt::format("[contact]\nlaw = \"{}\"\nrestitution = {:.17g}\nfriction = 0\n{}\n", law, restitution,
                       spring) +
           fmt::format(
               "[container]\nshape = \"box\"\nwidth = {0:.17g}\ndepth = {0:.17g}\nheight = {0:.17g}\n",
               edge) +
           "[run]\nduration = 1\n";
}

// The balance looks at every contact after every step, which an elastic gas can do without.
class Watched {
  public:
    Watched(const Plan& plan, std::uint64_t seed)
        : gas_(plan, cube_of(seed)),
          loses_(plan.grain[0].restitution < 1),
          start_(gas_.energy()),
          balance_(gas_.bench.around, gas_.bench.grains, *gas_.bench.loop, 0, plan.clock.step) {}
    Watched(const Watched&) = delete;

    void run(std::int64_t steps) {
        if (!loses_) return gas_.bench.run(steps);
        for (; steps > 0; --steps) {
            gas_.bench.run(1);
            balance_.note(gas_.bench.step);
        }
    }
    std::int64_t step() const { return gas_.bench.step; }
    GasEnergy energy() const {
        if (!loses_) return {step(), gas_.energy() / start_ - 1, 0};
        return {step(), balance_.residual() / start_, balance_.terms().lost() / start_};
    }

  private:
    Gas gas_;
    bool loses_;
    double start_;  // J
    EnergyBalance balance_;
};

}  // namespace

Plan gas_plan(const GasSetting& setting, double restitution) {
    using Corrected = GasSetting::Corrected;
    Plan plan = make_plan(read_scene_text(scene_text(setting.law, restitution), "gas.toml", setting.sets));
    if (setting.corrected != Corrected::as_planned) {
        const NormalForce law = setting.corrected == Corrected::yes ? NormalForce::walton_braun_corrected
                                                                    : NormalForce::walton_braun;
        for (auto* kinds : {&plan.grain, &plan.wall})
            for (PairPlan& pair : *kinds) pair.model.normal = law;
    }
    if (setting.forces_a_contact > 0)
        plan.clock.step = plan.grain[0].contact_time / setting.forces_a_contact *
                          static_cast<double>(scheme_of(plan.integrator).stages.size());
    return plan;
}

std::vector<GasEnergy> gas_energy(const Plan& plan, std::uint64_t seed, const std::vector<double>& times,
                                  const std::function<bool()>& goes_on) {
    constexpr std::int64_t at_once = 2000;  // steps
    const double contact = std::numbers::pi * std::sqrt(bench_mass() / 2 / stiffness);
    Watched gas(plan, seed);
    std::vector<GasEnergy> all;
    for (const double time : times) {
        const auto end = static_cast<std::int64_t>(time * contact / plan.clock.step);
        while (gas.step() < end) {
            gas.run(std::min(at_once, end - gas.step()));
            if (!goes_on()) return {};
        }
        all.push_back(gas.energy());
    }
    return all;
}

}  // namespace grainreel
