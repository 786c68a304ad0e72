// Beds as scenes make them: at rest with a step that is too long, shaken gently sideways, shaken hard.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/bench.hpp"
#include "engine/lab/chart/limits/experiment.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {
namespace {

constexpr double frequency = 20;  // Hz

std::string box(int grains, double duration) {
    return fmt::format(
        "[[species]]\nname = \"glass\"\ncount = {}\ndiameter = {}\ndensity = {}\n"
        "[contact]\nrestitution = 0.9\nfriction = 0.4\n"
        "[container]\nshape = \"box\"\nwidth = \"24 mm\"\ndepth = \"24 mm\"\nheight = \"100 mm\"\n"
        "[run]\nduration = {}\n[output]\ntrajectory = false\n",
        grains, 2 * bench_radius, bench_density, duration);
}

// J over m g d: the kinetic energy of a grain of a bed at rest. Throws when the health check stops the run.
double restlessness(double step, int grains) {
    constexpr double stiffness = 2000;  // N/m
    const double unit = std::sqrt(bench_mass() / stiffness);
    const Scene scene = read_scene_text(box(grains, 1), "bed.toml",
                                        {fmt::format("contact.stiffness={}", stiffness),
                                         fmt::format("run.step={}", step * unit), "start.settle_limit=2"});
    const Plan plan = make_plan(scene);
    Simulation simulation(scene, plan, 1);
    simulation.pack();
    simulation.advance(plan.steps);
    return simulation.measure("kinetic_J") /
           (grains * bench_mass() * scene.gravity.norm() * 2 * bench_radius);
}

// Loose and with losses: from where on the health check stops it.
Finding resting_bed(bool quick) {
    Finding finding;
    finding.theory = 2 / std::sqrt(8.0);
    finding.usual = usual_step() / std::sqrt(bench_mass() / bench_stiffness);
    for (const double step : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2}) {
        try {
            finding.curve.push_back({step, restlessness(step, quick ? 60 : 200)});
        } catch (const RunError&) {
            finding.measured = step;
            return finding;
        }
    }
    return finding;
}

// Shaken sideways, gently enough for all contacts to hold.
const char* tray = R"([[species]]
name = "glass"
count = 150
diameter = { min = "3.6 mm", max = "4.4 mm" }
density = 2500
[contact]
restitution = 0.5
friction = 0.8
[container]
shape = "box"
width = "28 mm"
depth = "20 mm"
height = "60 mm"
[drive]
frequency = 20
g_level = 0.2
direction = [0, 1, 0]
[output]
trajectory = false
)";

// Mean way of a grain a period over its diameter, from the end of the tenth period to that of the last.
double creep_of(LeverArms arms, int seed, int periods) {
    constexpr int settled = 10;
    const Scene scene = read_scene_text(
        tray, "tray.toml",
        {std::string("contact.arms=") + (arms == LeverArms::radius ? "radius" : "contact-plane"),
         fmt::format("run.seed={}", seed), fmt::format("run.duration={}", (settled + periods) / frequency)});
    const Plan plan = make_plan(scene);
    Simulation simulation(scene, plan, 1);
    simulation.pack();
    simulation.advance(settled * plan.clock.steps_per_period);
    const Frame start = simulation.frame();
    simulation.advance(plan.steps);
    const Frame end = simulation.frame();
    double way = 0;
    for (std::size_t i = 0; i < end.size(); ++i)
        way += (end.position[i] - start.position[i]).norm() / (2 * end.radius[i]);
    return way / static_cast<double>(end.size()) / periods;
}

Finding creep(LeverArms arms, bool quick) {
    const int seeds = quick ? 1 : 8;
    Finding finding;
    finding.measured = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        finding.curve.push_back({static_cast<double>(seed), creep_of(arms, seed, quick ? 10 : 100)});
        finding.measured += finding.curve.back().value / seeds;
    }
    return finding;
}

// The largest overlap seen over the largest that the plan expects; a run that its health check stops throws.
Finding hard_shaking(bool quick) {
    Finding finding;
    finding.theory = 1;
    finding.measured = 0;
    for (const double level :
         quick ? std::vector<double>{3, 20} : std::vector<double>{1, 2, 3, 5, 8, 12, 16, 20}) {
        const Scene scene =
            read_scene_text(box(quick ? 60 : 200, quick ? 0.3 : 0.5) +
                                fmt::format("[drive]\nfrequency = {}\ng_level = {}\n", frequency, level),
                            "bed.toml");
        const Plan plan = make_plan(scene);
        Simulation simulation(scene, plan, 1);
        simulation.pack();
        double largest = 0;
        for (std::int64_t step = 0; step < plan.steps;) {
            step = std::min(plan.steps, step + 20);
            simulation.advance(step);
            largest = std::max(largest, 0.5 * simulation.measure("largest_overlap"));
        }
        finding.curve.push_back({level, largest, plan.expected_overlap});
        finding.measured = std::max(finding.measured, largest / plan.expected_overlap);
    }
    return finding;
}

}  // namespace

std::vector<Experiment> bed_experiments() {
    const auto silent = Failure::silent;
    const std::string way = "mean way a period / diameter";
    return {{"step: bed at rest in a box", "step / sqrt(m/K)", Failure::loud,
             "health check; check warns above the stable limit", resting_bed},
            {"creep under sideways shaking (arms to the plane)", way, silent, "none",
             [](bool quick) { return creep(LeverArms::contact_plane, quick); }},
            {"creep under sideways shaking (arms of the radius)", way, silent, "check warns of arms = radius",
             [](bool quick) { return creep(LeverArms::radius, quick); }},
            {"shaking at 1 to 20 g", "largest overlap / expected", Failure::loud,
             "the plan's stiffness; health check", hard_shaking}};
}

}  // namespace grainreel
