// Contacts that last too long for their drive: a deep bed follows its plate like jelly, and a plate turns
// round during an impact.
#include <algorithm>
#include <complex>
#include <numbers>

#include "engine/lab/chart/bench.hpp"
#include "engine/lab/chart/limits/experiment.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

constexpr double speed = 0.3;  // m/s, of an impact

// ---- a soft bed: the top of a column of elastic grains, shaken so gently that nothing comes apart ----

// Top over plate: cos(q/2) / cos((n + 1/2) q) with sin(q/2) = (omega / 2) sqrt(m/K) (der).
double chain_gain(int count, double omega) {
    const double q = 2 * std::asin(0.5 * omega * std::sqrt(bench_mass() / bench_stiffness));
    return std::cos(q / 2) / std::cos((count + 0.5) * q);
}

double measured_gain(int count, double omega) {
    constexpr int ramp = 12, looked_at = 4;
    const double unit = std::sqrt(bench_mass() / bench_stiffness), gravity = 9.81;
    const double period = 2 * pi / omega;
    const int steps = 8 * static_cast<int>(std::ceil(period / (0.05 * unit) / 8));
    Bench bench(latching_pair(bench_stiffness, 1), period / steps);
    bench.plan.clock.steps_per_period = steps;
    Drive drive;
    drive.present = true;
    drive.frequency = 1 / period;
    drive.amplitude = 0.02 * gravity / (omega * omega);
    drive.ramp = ramp;
    bench.add_floor();
    bench.around.faces[0].body.driven = true;
    bench.around.motion = WallMotion(drive, bench.plan.clock);
    bench.around.gravity = {0, 0, -gravity};
    double z = -bench_radius;
    for (int k = 0; k < count; ++k) {
        const double weight = (count - k) * bench_mass() * gravity;
        z += 2 * bench_radius - weight / bench_stiffness;
        bench.add(Vec3(0, 0, z));
    }
    bench.start();
    bench.run(static_cast<std::int64_t>(ramp) * steps);
    std::complex<double> sum = 0;
    for (int k = 0; k < looked_at * steps; ++k) {
        bench.run(1);
        sum += (bench.position(count - 1).z() - z) * std::polar(1.0, -2 * pi * k / steps);
    }
    return 2 * std::abs(sum) / (looked_at * steps) / drive.amplitude;
}

Finding soft_column(bool quick) {
    constexpr int count = 10;
    constexpr double doubled = 2;
    const double unit = std::sqrt(bench_mass() / bench_stiffness);
    const auto omega_of = [&](double share) { return 2 * pi * share / (count * unit); };
    Finding finding;
    for (const double share : {0.01, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14, 0.155, 0.17, 0.185, 0.2}) {
        if (quick && share < 0.05) continue;
        finding.curve.push_back(
            {share, measured_gain(count, omega_of(share)), chain_gain(count, omega_of(share))});
        const std::size_t n = finding.curve.size();
        if (n < 2 || finding.curve[n - 2].value > doubled || finding.curve[n - 1].value < doubled) continue;
        const CurvePoint &low = finding.curve[n - 2], &high = finding.curve[n - 1];
        finding.measured = low.x + (high.x - low.x) * (doubled - low.value) / (high.value - low.value);
    }
    finding.theory = last_that_holds(
        0.01, 0.2, 40, [&](double share) { return chain_gain(count, omega_of(share)) < doubled; });
    finding.usual = 0.1 / pi;  // the plan: f h t_c <= 0.1 d, t_c about pi sqrt(m/K)
    return finding;
}

// ---- a plate that turns round during an impact; plate's top speed = speed of the ball, elastic ----

double plate_velocity(double omega, double phase, double t) {
    return speed * std::cos(omega * t + phase);
}

// Closed form: y'' = -W^2 (y - a sin(wt + p)) + constant, until the ball is back at the plate.
double rebound_by_theory(double natural, double omega, double phase) {
    const double swing = speed / omega * natural * natural / (natural * natural - omega * omega);
    const double start = speed / omega * std::sin(phase);  // the plate's place at t = 0, taken off
    const double a = start - swing * std::sin(phase);
    const double b = (-speed - swing * omega * std::cos(phase)) / natural;
    const auto ball = [&](double t) {
        return a * std::cos(natural * t) + b * std::sin(natural * t) + swing * std::sin(omega * t + phase);
    };
    const auto apart = [&](double t) { return ball(t) - speed / omega * std::sin(omega * t + phase); };
    double t = 1e-3 / natural;
    while (apart(t) < 0 && t < 100 / natural) t += 1e-3 / natural;
    return natural * (b * std::cos(natural * t) - a * std::sin(natural * t)) +
           swing * omega * std::cos(omega * t + phase);
}

double rebound_measured(double natural, double omega, double phase) {
    const double period = 2 * pi / omega;
    const auto steps = 8 * static_cast<std::int64_t>(std::ceil(period * natural / 0.01 / 8));
    Bench bench(latching_pair(bench_stiffness, 1), period / static_cast<double>(steps));
    bench.plan.clock.steps_per_period = steps;
    bench.plan.clock.initial_phase = phase / (2 * pi);
    Drive drive;
    drive.present = true;
    drive.frequency = 1 / period;
    drive.amplitude = speed / omega;
    drive.phase = bench.plan.clock.initial_phase;
    drive.ramp = 0;
    bench.add_floor();
    bench.around.faces[0].body.driven = true;
    bench.around.motion = WallMotion(drive, bench.plan.clock);
    bench.add(Vec3(0, 0, bench_radius), Vec3(0, 0, -speed));
    bench.start();
    bool touched = false;
    while (bench.plan.clock.time(bench.step) < 100 / natural) {
        bench.run(1);
        const bool touches = bench.grains.load[0].force.z() > 0;
        if (touched && !touches) break;
        touched |= touches;
    }
    return bench.velocity(0).z();
}

// How far the rebound is off that from a plate whose velocity does not change meanwhile, over the speed, at
// worst.
Finding drive_near_contact(bool quick) {
    constexpr double off = 0.1;
    const double natural = std::sqrt(bench_stiffness / bench_mass());
    const int phases = quick ? 8 : 24;
    const auto errors = [&](double share) {  // share: t_c f, t_c = pi / natural
        const double omega = 2 * natural * share;
        CurvePoint point{share, 0, 0};
        for (int k = 0; k < phases; ++k) {
            const double phase = 2 * pi * (k + 0.5) / phases, plate = plate_velocity(omega, phase, 0);
            const double closing = speed + plate, rigid = speed + 2 * plate;
            if (closing < 0.2 * speed) continue;  // hardly meets
            point.value =
                std::max(point.value, std::abs(rebound_measured(natural, omega, phase) - rigid) / speed);
            point.theory =
                std::max(point.theory, std::abs(rebound_by_theory(natural, omega, phase) - rigid) / speed);
        }
        return point;
    };
    Finding finding;
    for (const double share : logarithmic(0.003, 1.03, quick ? 8 : 16))
        finding.curve.push_back(errors(share));
    finding.measured = last_that_holds(1e-3, 0.3, 9, [&](double share) { return errors(share).value < off; });
    finding.theory = last_that_holds(1e-3, 0.3, 9, [&](double share) { return errors(share).theory < off; });
    return finding;
}

}  // namespace

std::vector<Experiment> softness_experiments() {
    const auto silent = Failure::silent;
    return {{"soft column", "frequency x layers sqrt(m/K) where the top moves twice as far", silent,
             "the plan's stiffness; check warns of slow waves", soft_column},
            {"drive as fast as a contact", "frequency x time of a contact where the rebound is 10 % off",
             silent, "check warns", drive_near_contact}};
}

}  // namespace grainreel
