// The drive: the kick of one that starts at once, and the walls' place in a step.
#include <algorithm>
#include <complex>
#include <numbers>

#include "engine/lab/chart/bench.hpp"
#include "engine/lab/chart/limits/experiment.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

constexpr double frequency = 20, gravity = 9.81;  // Hz, m/s2

std::unique_ptr<Bench> on_a_plate(const PairPlan& pair, int steps_a_period, double g_level, double ramp) {
    auto whole = std::make_unique<Bench>(pair, 1 / (frequency * steps_a_period));
    Bench& bench = *whole;
    bench.plan.clock.steps_per_period = steps_a_period;
    Drive drive;
    drive.present = true;
    drive.frequency = frequency;
    drive.amplitude = g_level * gravity / std::pow(2 * pi * frequency, 2);
    drive.ramp = ramp;
    bench.add_floor();
    bench.around.faces[0].body.driven = true;
    bench.around.motion = WallMotion(drive, bench.plan.clock);
    bench.around.gravity = {0, 0, -gravity};
    return whole;
}

// A ball at rest on a plate below 1 g: its largest speed against the plate over a omega, in every twentieth
// of the first three periods. Started at once the plate hits it at a omega, and it first leaves at e times
// that.
Finding kick(double ramp) {
    constexpr double e = 0.9, level = 0.9;
    constexpr int steps = 40000, points = 60;
    const auto whole = on_a_plate(latching_pair(bench_stiffness, e), steps, level, ramp);
    Bench& bench = *whole;
    bench.add(Vec3(0, 0, bench_radius - bench_mass() * gravity / bench_stiffness));
    bench.start();
    const double speed = level * gravity / (2 * pi * frequency);
    Finding finding;
    finding.theory = ramp > 0 ? 0 : e;
    finding.measured = 0;
    for (int point = 1; point <= points; ++point) {
        double largest = 0;
        for (int k = 0; k < 3 * steps / points; k += 10) {
            bench.run(10);
            const double plate = bench.around.motion.at(bench.step).velocity.z();
            largest = std::max(largest, bench.velocity(0).z() - plate);
        }
        finding.curve.push_back({3.0 * point / points, largest / speed});
        if (ramp > 0 || point == 1) finding.measured = std::max(finding.measured, largest / speed);
    }
    return finding;
}

// A ball on a spring and a dashpot on the plate, long after the start, against the steady swing a (K + i c w)
// / (K - m w^2 + i c w); the largest distance over the amplitude. The frequency is a fifth of the natural
// one.
double steady_error(int steps_a_period) {
    const double omega = 2 * pi * frequency, natural = 5 * omega, damping = natural;  // 1/s
    PairPlan pair;
    pair.model = {NormalForce::spring_dashpot, TangentialLaw::none};
    pair.loading_stiffness = pair.unloading_stiffness = natural * natural * bench_mass();
    pair.normal_damping = damping;
    const auto whole = on_a_plate(pair, steps_a_period, 0.5, 3);
    Bench& bench = *whole;
    const double amplitude = 0.5 * gravity / (omega * omega),
                 rest = bench_radius - gravity / (natural * natural);
    const std::complex<double> spring(natural * natural, damping * omega);
    const std::complex<double> swing = amplitude * spring / (spring - omega * omega);
    bench.add(Vec3(0, 0, rest));
    bench.start();
    bench.run(8 * steps_a_period);
    double largest = 0;
    for (int k = 0; k < steps_a_period; ++k) {
        bench.run(1);
        const double angle = 2 * pi * bench.plan.clock.phase(bench.step);
        const double should = rest + (swing * std::polar(1.0, angle)).imag();
        largest = std::max(largest, std::abs(bench.position(0).z() - should) / amplitude);
    }
    return largest;
}

// The order of the error: walls a step early or late would make it 1.
Finding order_of_walls(bool) {
    Finding finding;
    finding.theory = 2;
    const std::vector<int> counts = {40, 80, 160, 320, 640, 1280};
    const double first = steady_error(counts.front());
    for (const int steps : counts)
        finding.curve.push_back({static_cast<double>(steps), steady_error(steps),
                                 first * std::pow(static_cast<double>(counts.front()) / steps, 2)});
    const CurvePoint &low = finding.curve[1], &high = finding.curve.back();
    finding.measured = std::log(low.value / high.value) / std::log(high.x / low.x);
    return finding;
}

}  // namespace

std::vector<Experiment> drive_experiments() {
    const auto silent = Failure::silent;
    return {
        {"kick without ramp", "speed against the plate / (a omega)", silent,
         "ramp of 3 periods by default; check warns of none", [](bool) { return kick(0); }},
        {"kick with a ramp of 3 periods", "speed against the plate / (a omega)", silent, "the default",
         [](bool) { return kick(3); }},
        {"walls in a step", "order of the error", silent, "walls at the time of the force", order_of_walls}};
}

}  // namespace grainreel
