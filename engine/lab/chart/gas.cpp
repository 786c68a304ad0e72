#include "engine/lab/chart/gas.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/base/random.hpp"
#include "engine/measure/energy.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/step/motion/scheme.hpp"

namespace grainreel {

double GasInCube::free() const {
    return math::cbrt(count() * sphere_volume(bench_radius) / solid_fraction);
}

Gas::Gas(const Plan& plan, const GasInCube& in) : cube(in), world(plan, 0.5 * bench_radius) {
    const double edge = cube.edge();
    for (int axis = 0; axis < 3; ++axis) {
        world.add_plane(Vec3(0, 0, 0), Vec3::Unit(axis));
        world.add_plane(edge * Vec3::Unit(axis), -Vec3::Unit(axis));
    }
    Random random(cube.seed, Stream::velocities);
    for (int k = 0; k < cube.count(); ++k) {
        const Vec3 cell(k % cube.side, k / cube.side % cube.side, k / cube.side / cube.side);
        const double u = random.normal(), v = random.normal(), w = random.normal();
        world.add((cell + 0.5 * Vec3::Ones()) * edge / cube.side, cube.speed * Vec3(u, v, w));
    }
    world.start();
}

double Gas::temperature() const {
    return 2.0 / 3 * kinetic_energy(world.grains).translation / (cube.count() * bench_mass());
}

double Gas::energy() const {
    return world.kinetic() + summarise_contacts(*world.loop, world.step).stored;
}

void Gas::run_to(double seconds) {
    world.run(static_cast<std::int64_t>(seconds / world.plan.clock.step) - world.step);
}

namespace {

constexpr double kStiffness = 1e4;  // N/m
constexpr int kSide = 6;

GasInCube cube_of(std::uint64_t seed) {
    GasInCube cube;
    cube.side = kSide;
    cube.solid_fraction = 0.1;
    cube.seed = seed;
    return cube;
}

// E* of Hertz' contact that has the same energy as the linear spring at the overlap of 1 % that the plan
// allows. k a^(3/2) stores 2/5 k a^(5/2), with k = 4/3 E* sqrt(R/2).
double modulus() {
    const double overlap = 0.01 * 2 * bench_radius, k = 1.25 * kStiffness / std::sqrt(overlap);
    return 0.75 * k / std::sqrt(bench_radius / 2);
}

std::string scene_text(const std::string& law, double restitution) {
    const double edge = cube_of(1).edge();
    const std::string spring = law == "hertz" ? fmt::format("modulus = {:.17g}", modulus())
                                              : fmt::format("stiffness = {:.17g}", kStiffness);
    return "gravity = 0\n[[species]]\nname = \"grain\"\n" +
           fmt::format("count = {}\ndiameter = {:.17g}\ndensity = {:.17g}\n", kSide * kSide * kSide,
                       2 * bench_radius, bench_density) +
           fmt::format("[contact]\nlaw = \"{}\"\nrestitution = {:.17g}\nfriction = 0\n{}\n", law, restitution,
                       spring) +
           fmt::format(
               "[container]\nshape = \"box\"\nwidth = {0:.17g}\ndepth = {0:.17g}\nheight = {0:.17g}\n",
               edge) +
           "[run]\nduration = 1\n";
}

// A gas whose energy is watched. With lossy contacts the balance of energy needs a look at every contact
// after every step; without losses it does not.
class Watched {
  public:
    Watched(const Plan& plan, std::uint64_t seed)
        : gas_(plan, cube_of(seed)),
          loses_(plan.grain[0].restitution < 1),
          start_(gas_.energy()),
          balance_(gas_.world.around, gas_.world.grains, *gas_.world.loop, 0, plan.clock.step) {}
    Watched(const Watched&) = delete;

    void run(std::int64_t steps) {
        if (!loses_) return gas_.world.run(steps);
        for (; steps > 0; --steps) {
            gas_.world.run(1);
            balance_.note(gas_.world.step);
        }
    }
    std::int64_t step() const { return gas_.world.step; }
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
    constexpr std::int64_t at_once = 2000;  // steps between two questions to goes_on()
    const double contact = std::numbers::pi * std::sqrt(bench_mass() / 2 / kStiffness);
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

namespace {

// Number of force evaluations in a contact, as in the table of single contacts. The settings `planned`,
// spring-dashpot and Hertz take the step that the plan chooses.
constexpr double kForces = 12;
const GasSetting kPlain{"velocity Verlet", "walton-braun", {}, GasSetting::Corrected::no, kForces};
const GasSetting kCorrected{"with corrections", "walton-braun", {}, GasSetting::Corrected::yes, kForces};
const GasSetting kPlanned{"Walton-Braun as planned"};

GasSetting with_integrator(const char* name, const char* key) {
    GasSetting setting = kPlain;
    setting.name = name;
    setting.sets = {std::string("run.integrator=") + key};
    return setting;
}

std::vector<GasSetting> elastic_settings() {
    return {kPlain,
            kCorrected,
            with_integrator("leapfrog", "leapfrog"),
            with_integrator("position Verlet", "position-verlet"),
            with_integrator("Forest-Ruth", "forest-ruth"),
            with_integrator("Gear", "gear"),
            {"spring-dashpot", "spring-dashpot"},
            {"Hertz", "hertz"},
            kPlanned};
}

// A setting at one restitution, and the times at which its energy is measured, in contact times.
struct GasRun {
    GasSetting setting;
    double restitution;
    std::vector<double> times;
};
std::vector<GasRun> gas_runs(bool quick) {
    const std::vector<double> times =
        quick ? std::vector<double>{250, 500} : std::vector<double>{250, 500, 1000, 2000, 4000, 8000};
    std::vector<GasRun> all;
    for (const GasSetting& setting : elastic_settings()) all.push_back({setting, 1, times});
    const std::vector<double> nearly =
        quick ? std::vector<double>{0.9, 0.999}
              : std::vector<double>{0.9, 0.95, 0.98, 0.99, 0.995, 0.997, 0.998, 0.999, 0.9995, 0.9999};
    for (const GasSetting& setting : {kPlain, kCorrected, kPlanned})
        for (const double e : nearly) all.push_back({setting, e, {quick ? 250.0 : 1000.0}});
    return all;
}
int seeds(bool quick) {
    return quick ? 1 : 4;
}

}  // namespace

std::size_t gas_drift_pieces(bool quick) {
    return gas_runs(quick).size() * static_cast<std::size_t>(seeds(quick));
}

bool run_gas_drift(bool quick, ResultTable& table, ChartWork& work) {
    for (const GasRun& run : gas_runs(quick)) {
        const std::string& name = run.setting.name;
        for (int seed = 1; seed <= seeds(quick); ++seed) {
            if (!work.next(fmt::format("gas, {}, e = {}, seed {}", name, run.restitution, seed)))
                return false;
            const auto key = [&](double time) {
                return std::vector<std::string>{name, number(run.restitution), number(seed), number(time)};
            };
            if (table.has(key(run.times.back()))) continue;
            const auto energies =
                gas_energy(gas_plan(run.setting, run.restitution), static_cast<std::uint64_t>(seed),
                           run.times, [&] { return work.goes_on(); });
            if (energies.empty()) return false;
            for (std::size_t k = 0; k < run.times.size(); ++k) {
                const GasEnergy& is = energies[k];
                std::vector<std::string> row = key(run.times[k]);
                if (table.has(row)) continue;
                for (const double value : {static_cast<double>(is.steps), is.gained, is.lost})
                    row.push_back(number(value));
                table.add(row);
            }
        }
    }
    return true;
}

const char* gas_drift_drawing() {
    return R"(    set output 'gas.'.form
    set logscale xy
    set multiplot layout 2,1
    # As they are coloured above, where `mixed precision` is the third.
    elastic = "'velocity Verlet' 'with corrections' '' 'leapfrog' 'position Verlet' 'Forest-Ruth' 'Gear' 'spring-dashpot'"
    planned = 'Walton-Braun as planned'
    # Root mean square over the seeds, of what is gained over the energy, or over what is lost.
    over_time(m) = sprintf("< awk -F, '$1==\"%s\" && $2==1 {s[$4] += $6^2; n[$4]++} END {for (x in s) print x\",\"sqrt(s[x]/n[x])}' gas.csv | sort -g", m)
    over_loss(m) = sprintf("< awk -F, '$1==\"%s\" && $2<1 {x = 1-$2^2; s[x] += ($6/$7)^2; n[x]++} END {for (x in s) print x\",\"sqrt(s[x]/n[x])}' gas.csv | sort -g", m)
    set xrange [200:10000]
    set xlabel 'time over the duration of a contact'
    set ylabel '|gained energy| / energy'
    set title 'An elastic gas of 216 smooth grains'
    plot for [k in "1 2 4 5 6 7 8"] over_time(word(elastic, k+0)) using 1:2 title word(elastic, k+0) lw 2 lc (k+0) pt (k+0), over_time('Hertz') using 1:2 title 'Hertz' lw 2 lc 'gray50' pt 9, over_time(planned) using 1:2 title planned with points pt 6 ps 1.5 lw 2 lc 'black'
    set xrange [0.3:1e-4]
    set yrange [1e-4:2]
    set format x "10^{%L}"
    set xlabel '1 - e^2, the share of its energy that an impact takes'
    set ylabel '|gained energy| / lost energy'
    set title 'Nearly elastic gases'
    plot for [k=1:2] over_loss(word(elastic, k)) using 1:2 title word(elastic, k) lw 2 lc k pt k, over_loss(planned) using 1:2 title planned with points pt 6 ps 1.5 lw 2 lc 'black', 1 lc 'gray30' lw 2 dt 2 title 'nothing is lost'
    unset multiplot
    unset title
    set format x '%g'
    set autoscale
)";
}

}  // namespace grainreel
