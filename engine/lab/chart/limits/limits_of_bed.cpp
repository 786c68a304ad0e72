// Limits of beds as scenes make them: at rest with too long a step, shaken gently sideways, and shaken hard.
// Also errors of the drive, and round-off of positions.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace {

constexpr double kFrequency = 20;  // Hz

std::string box(int grains, double duration) {
    return fmt::format(
        "[[species]]\nname = \"glass\"\ncount = {}\ndiameter = {}\ndensity = {}\n"
        "[contact]\nrestitution = 0.9\nfriction = 0.4\n"
        "[container]\nshape = \"box\"\nwidth = \"24 mm\"\ndepth = \"24 mm\"\nheight = \"100 mm\"\n"
        "[run]\nduration = {}\n[output]\ntrajectory = false\n",
        grains, 2 * bench_radius, bench_density, duration);
}

// Mean kinetic energy of a grain of a bed at rest, divided by m g d. Throws when the health check stops the
// run.
double restlessness(double step, int grains) {
    constexpr double stiffness = 2000;  // N/m
    const double unit = std::sqrt(bench_mass() / stiffness);
    const Scene scene = read_scene_text(box(grains, 1), "bed.toml",
                                        {fmt::format("contact.stiffness={}", stiffness),
                                         fmt::format("run.step={}", step * unit), "start.settle_limit=2"});
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 1);
    simulation.pack();
    simulation.advance(plan.steps);
    return simulation.measure("kinetic_J") /
           (grains * bench_mass() * scene.gravity.norm() * 2 * bench_radius);
}

// A loose bed with losses: finds the step from which on the health check stops it. The theory is the limit of
// a dense crystal (limits_of_step.cpp).
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

// A bed that is shaken sideways, gently enough for all contacts to hold.
const char* kTray = R"([[species]]
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

// How far a grain creeps in a period: its displacement from the end of the tenth period to the end of the
// last, divided by its diameter and the number of periods; the mean over all grains.
double creep_of(LeverArms arms, int seed, int periods) {
    constexpr int settled = 10;
    const Scene scene = read_scene_text(
        kTray, "tray.toml",
        {std::string("contact.arms=") + (arms == LeverArms::radius ? "radius" : "contact-plane"),
         fmt::format("run.seed={}", seed), fmt::format("run.duration={}", (settled + periods) / kFrequency)});
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 1);
    simulation.pack();
    simulation.advance(settled * plan.clock.steps_per_period);
    const State start = simulation.frame();
    simulation.advance(plan.steps);
    const State end = simulation.frame();
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

// The largest overlap seen in any of the runs, divided by the one that the plan expects there. Throws when
// the health check stops a run.
Finding hard_shaking(bool quick) {
    Finding finding;
    finding.theory = 1;
    finding.measured = 0;
    for (const double level :
         quick ? std::vector<double>{3, 20} : std::vector<double>{1, 2, 3, 5, 8, 12, 16, 20}) {
        const Scene scene =
            read_scene_text(box(quick ? 60 : 200, quick ? 0.3 : 0.5) +
                                fmt::format("[drive]\nfrequency = {}\ng_level = {}\n", kFrequency, level),
                            "bed.toml");
        const Plan plan = make_plan(scene);
        SimulatedBed simulation(scene, plan, 1);
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
    const auto silent = Failing::silent;
    const std::string way = "mean way a period / diameter";
    return {{"step: bed at rest in a box", "step / sqrt(m/K)", Failing::loud,
             "health check; check warns above the stable limit", resting_bed},
            {"creep under sideways shaking (arms to the plane)", way, silent, "none",
             [](bool quick) { return creep(LeverArms::contact_plane, quick); }},
            {"creep under sideways shaking (arms of the radius)", way, silent, "check warns of arms = radius",
             [](bool quick) { return creep(LeverArms::radius, quick); }},
            {"shaking at 1 to 20 g", "largest overlap / expected", Failing::loud,
             "the plan's stiffness; health check", hard_shaking}};
}

// Errors of the drive: without a ramp at its start the plate hits the grains (a kick), and walls may be at a
// wrong place within a step.

namespace {

using std::numbers::pi;

constexpr double kGravity = 9.81;  // m/s2

std::unique_ptr<SmallWorld> on_a_plate(const PairPlan& pair, int steps_a_period, double g_level,
                                       double ramp) {
    auto whole = std::make_unique<SmallWorld>(pair, 1 / (kFrequency * steps_a_period));
    SmallWorld& world = *whole;
    world.plan.clock.steps_per_period = steps_a_period;
    Drive drive;
    drive.present = true;
    drive.frequency = kFrequency;
    drive.amplitude = g_level * kGravity / math::square(2 * pi * kFrequency);
    drive.ramp = ramp;
    world.add_floor();
    world.around.faces[0].body.driven = true;
    world.around.motion = DriveMotion(drive, world.plan.clock);
    world.around.gravity = {0, 0, -kGravity};
    return whole;
}

// A ball at rest on a plate that is shaken below 1 g: its largest speed relative to the plate, divided by a
// omega, in each twentieth of a period, for three periods. If the drive starts without a ramp, the plate hits
// the ball with the speed a omega, and the ball leaves with e times that.
Finding kick(double ramp) {
    constexpr double e = 0.9, level = 0.9;
    constexpr int steps = 40000, points = 60;
    const auto whole = on_a_plate(latching_pair(bench_stiffness, e), steps, level, ramp);
    SmallWorld& world = *whole;
    world.add(Vec3(0, 0, bench_radius - bench_mass() * kGravity / bench_stiffness));
    world.start();
    const double speed = level * kGravity / (2 * pi * kFrequency);
    Finding finding;
    finding.theory = ramp > 0 ? 0 : e;
    finding.measured = 0;
    for (int point = 1; point <= points; ++point) {
        double largest = 0;
        for (int k = 0; k < 3 * steps / points; k += 10) {
            world.run(10);
            const double plate = world.around.motion.at(world.step).velocity.z();
            largest = std::max(largest, world.velocity(0).z() - plate);
        }
        finding.curve.push_back({3.0 * point / points, largest / speed});
        if (ramp > 0 || point == 1) finding.measured = std::max(finding.measured, largest / speed);
    }
    return finding;
}

// Error of a ball on a spring and a dashpot on the plate, long after the start: the largest distance from
// the steady swing a (K + i c w) / (K - m w^2 + i c w), divided by the amplitude. The frequency of the drive
// is a fifth of the natural one.
double steady_error(int steps_a_period) {
    const double omega = 2 * pi * kFrequency, natural = 5 * omega, damping = natural;  // 1/s
    PairPlan pair;
    pair.model = {NormalForce::spring_dashpot, TangentialLaw::none};
    pair.loading_stiffness = pair.unloading_stiffness = natural * natural * bench_mass();
    pair.normal_damping = damping;
    const auto whole = on_a_plate(pair, steps_a_period, 0.5, 3);
    SmallWorld& world = *whole;
    const double amplitude = 0.5 * kGravity / (omega * omega),
                 rest = bench_radius - kGravity / (natural * natural);
    const std::complex<double> spring(natural * natural, damping * omega);
    const std::complex<double> swing = amplitude * spring / (spring - omega * omega);
    world.add(Vec3(0, 0, rest));
    world.start();
    world.run(8 * steps_a_period);
    double largest = 0;
    for (int k = 0; k < steps_a_period; ++k) {
        world.run(1);
        const double angle = 2 * pi * world.plan.clock.phase(world.step);
        const auto [sine, cosine] = math::sin_cos(angle);
        const double should = rest + swing.real() * sine + swing.imag() * cosine;
        largest = std::max(largest, std::abs(world.position(0).z() - should) / amplitude);
    }
    return largest;
}

// The order of this error. If walls were a step early or late, it would be 1.
Finding order_of_walls(bool) {
    Finding finding;
    finding.theory = 2;
    const std::vector<int> counts = {40, 80, 160, 320, 640, 1280};
    const double first = steady_error(counts.front());
    for (const int steps : counts)
        finding.curve.push_back({static_cast<double>(steps), steady_error(steps),
                                 first * math::square(static_cast<double>(counts.front()) / steps)});
    const CurvePoint &low = finding.curve[1], &high = finding.curve.back();
    finding.measured = math::log(low.value / high.value) / math::log(high.x / low.x);
    return finding;
}

}  // namespace

std::vector<Experiment> drive_experiments() {
    const auto silent = Failing::silent;
    return {
        {"kick without ramp", "speed against the plate / (a omega)", silent,
         "ramp of 3 periods by default; check warns of none", [](bool) { return kick(0); }},
        {"kick with a ramp of 3 periods", "speed against the plate / (a omega)", silent, "the default",
         [](bool) { return kick(3); }},
        {"walls in a step", "order of the error", silent, "walls at the time of the force", order_of_walls}};
}

// Round-off: a bead at rest on a plate sinks in by m g / K. When a unit in the last place of its position
// is as large as that, the contact force is random. The bead is a glass ball of 3 mm, 0.3 m from the origin,
// as in a hopper.

namespace {

constexpr double kHeight = 0.3, kRadius = 0.0015;  // m

double weight() {
    return sphere_mass_of(kRadius) * kGravity;
}

// Unit in the last place (m) of a position at `height`.
double last_place(bool in_single) {
    return in_single ? std::nextafter(static_cast<float>(kHeight), 1.0F) - static_cast<float>(kHeight)
                     : std::nextafter(kHeight, 1.0) - kHeight;
}

// Error |N / (m g) - 1| of a bead at rest on a spring with a dashpot, root mean square over time. The plate
// is higher than `height` by `shift` units in the last place.
double force_error(double stiffness, bool in_single, double shift) {
    const double mass = sphere_mass_of(kRadius), natural = std::sqrt(stiffness / mass);
    PairPlan pair;
    pair.model = {NormalForce::spring_dashpot, TangentialLaw::none};
    pair.loading_stiffness = pair.unloading_stiffness = stiffness;
    pair.normal_damping = natural;
    SmallWorld world(pair, 0.1 / natural);
    world.around.gravity = {0, 0, -kGravity};
    const double plate = kHeight + shift * last_place(in_single);
    world.add_plane(Vec3(0, 0, plate), Vec3(0, 0, 1));
    world.add(Vec3(0, 0, plate + kRadius - weight() / stiffness), Vec3::Zero(), {kRadius, bench_density});
    world.start();
    constexpr int settling = 3000, looked_at = 3000;
    double squares = 0;
    for (int k = 0; k < settling + looked_at; ++k) {
        world.run(1);
        double& z = world.grains.place[0].position.z();
        if (in_single) z = static_cast<float>(z);
        if (k < settling) continue;
        const double overlap = kRadius - (z - plate);
        squares += math::square(stiffness * std::max(0.0, overlap) / weight() - 1);
    }
    return std::sqrt(squares / looked_at);
}

double worst_error(double stiffness, bool in_single) {
    double worst = 0;
    for (double shift = 0; shift < 1; shift += 0.125)
        worst = std::max(worst, force_error(stiffness, in_single, shift));
    return worst;
}

// The stiffness at which half of the force is error. By theory the position is then wrong by half a unit in
// the last place, at an overlap of one unit.
Finding rounding(bool in_single) {
    Finding finding;
    const double limit = weight() / last_place(in_single);  // N/m
    for (const double share : logarithmic(1e-4, 30, 12))
        finding.curve.push_back({share * limit, worst_error(share * limit, in_single), 0.5 * share});
    finding.theory = limit;
    finding.measured =
        limit * math::exp(last_that_holds(math::log(1e-3), math::log(30.0), 12, [&](double share) {
            return worst_error(math::exp(share) * limit, in_single) < 0.5;
        }));
    finding.usual = 2e4;
    return finding;
}

}  // namespace

std::vector<Experiment> number_experiments() {
    return {{"rounding in single precision", "stiffness in N/m", Failing::silent,
             "the engine computes in double", [](bool) { return rounding(true); }},
            {"rounding in double precision", "stiffness in N/m", Failing::silent, "check warns",
             [](bool) { return rounding(false); }}};
}

}  // namespace grainreel
