// Limits of fast grains: they go through each other, through a wall, past each other between two steps, or
// out of reach of the neighbour lists. Also contacts that last too long for their drive.

#include <algorithm>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/random.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/lab/chart/small_world.hpp"

namespace grainreel {

namespace {

// Two equal grains meet head-on. Gives the speed after the impact divided by that before, below zero where
// they went through each other. `speed` is in units of 2 r sqrt(K / m_eff), `step` of sqrt(m_eff / K).
double after_head_on(double speed, double step, double phase) {
    const double frequency = std::sqrt(bench_stiffness / (0.5 * bench_mass()));
    const double closing = speed * 2 * bench_radius * frequency, length = step / frequency;
    SmallWorld world(latching_pair(bench_stiffness, 1), length);
    const double apart = bench_radius + 0.5 * phase * closing * length;
    world.add(Vec3(-apart, 0, 0), Vec3(0.5 * closing, 0, 0));
    world.add(Vec3(apart, 0, 0), Vec3(-0.5 * closing, 0, 0));
    world.start();
    while ((world.position(1) - world.position(0)).norm() < 2.5 * apart &&
           static_cast<double>(world.step) < 100 / step)
        world.run(1);
    return (world.velocity(1) - world.velocity(0)).x() / closing;
}

// The speed of impacts that the plan expects, in units of 2 r sqrt(K1/m_eff). It is the allowed overlap
// divided by the diameter.
double usual_speed() {
    const ImpactScene impact;
    const Plan plan = plan_of(impact);
    const PairPlan& pair = plan.between(0, 0);
    return plan.impact_speed / (2 * bench_radius * std::sqrt(pair.loading_stiffness / pair.effective_mass));
}

Finding through_each_other(bool) {
    constexpr double step = 0.01;
    Finding finding;
    finding.theory = 1;
    finding.usual = usual_speed();
    for (const double speed : {0.01, 0.1, 0.5, 0.8, 0.9, 0.95, 0.99, 1.01, 1.05, 1.1, 1.2, 1.5, 2.0})
        finding.curve.push_back({speed, after_head_on(speed, step, 0.5), speed < 1 ? 1 : -1.0});
    finding.measured =
        last_that_holds(0.5, 2, 14, [](double speed) { return after_head_on(speed, step, 0.5) > 0; });
    return finding;
}

// A plane pushes a grain back from any depth. The health check stops a run at a depth of 2 r.
Finding through_a_wall(bool) {
    constexpr double steps = 200;  // in a quarter period
    Finding finding;
    finding.theory = 1;
    const double frequency = std::sqrt(bench_stiffness / bench_mass());
    const auto depth = [&](double speed) {
        SmallWorld world(latching_pair(bench_stiffness, 1), std::numbers::pi / 2 / frequency / steps);
        world.add_floor();
        world.add(Vec3(0, 0, bench_radius), Vec3(0, 0, -speed * 2 * bench_radius * frequency));
        world.start();
        double deepest = 0;
        for (int k = 0; k < 2 * steps; ++k) {
            world.run(1);
            deepest = std::max(deepest, bench_radius - world.position(0).z());
        }
        return deepest / (2 * bench_radius);
    };
    for (const double speed : logarithmic(0.01, 2, 9)) finding.curve.push_back({speed, depth(speed), speed});
    finding.usual = usual_speed();
    finding.measured = last_that_holds(0.1, 2, 14, [&](double speed) { return depth(speed) < 1; });
    return finding;
}

// Two fast grains may pass each other between two steps without an overlap at either. They overlap along a
// way of 2 (r_i + r_j).
Finding past_each_other(bool quick) {
    Finding finding;
    finding.theory = 1;
    // The share of phases at which the meeting is missed. chord: way of a step divided by 2 (r_i + r_j).
    const auto missed = [&](double chord) {
        constexpr double step = 1e-3;  // forces hardly matter here
        const int phases = quick ? 20 : 100;
        int count = 0;
        for (int phase = 0; phase < phases; ++phase)
            count += after_head_on(2 * chord / step, step, (phase + 0.5) / phases) == -1;
        return static_cast<double>(count) / phases;
    };
    for (const double chord : {0.5, 0.8, 0.9, 1.1, 1.25, 1.5, 2.0, 3.0, 5.0})
        finding.curve.push_back({chord, missed(chord), std::max(0.0, 1 - 1 / chord)});
    finding.measured = last_that_holds(0.5, 3, 10, [&](double chord) { return missed(chord) == 0; });
    const Plan plan = plan_of(ImpactScene());
    finding.usual = plan.impact_speed * plan.clock.step / (4 * bench_radius);
    return finding;
}

std::size_t touching_by_search(const Grains& grains, double period) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            Vec3 apart = grains.place[i].position - grains.place[j].position;
            apart.x() = nearest_image(apart.x(), period);
            count += apart.norm() < grains.place[i].radius + grains.place[j].radius;
        }
    }
    return count;
}

// Grains of two sizes fly through each other and a moving floor. For each step the share of touching pairs
// and wall contacts that the loop has in its lists is found; gives the smallest of these. `way` is how far a
// grain moves in a step, divided by the skin of the lists.
double share_listed(double way, int steps) {
    constexpr double half = 0.012, step = 1e-5;
    SmallWorld world(latching_pair(1e-9, 1), step);
    world.around.period = 2 * half;
    const double speed = way * world.around.skin / step;
    Random random(7, Stream::centres);
    for (int k = 0; k < 300; ++k) {
        const Vec3 velocity = random.in_cube(speed), place = random.in_cube(half);
        world.add(place, velocity, {k % 5 == 0 ? bench_radius : 0.4 * bench_radius});
    }
    world.add_plane(Vec3(0, 0, -half), Vec3(0, 0, 1));
    world.around.faces[0].body.velocity = {0, 0, speed};
    world.start();
    double least = 1;
    for (int k = 0; k < steps; ++k) {
        for (Place& p : world.grains.place)  // keeps grains in a box by turning them back
            for (int axis = 1; axis < 3; ++axis)
                if (std::abs(p.position[axis]) > half) {
                    double& v = world.grains.motion[&p - world.grains.place.data()].velocity[axis];
                    v = std::copysign(v, -p.position[axis]);
                }
        world.run(1);
        std::size_t expected = touching_by_search(world.grains, world.around.period), found = 0;
        for (const Place& p : world.grains.place) {
            const Vec3 moved = world.around.faces[0].displacement(world.around.motion.at(world.step));
            expected += distance_to(world.around.faces[0], moved, p.position).distance < p.radius;
        }
        world.loop->visit_contacts(world.step, [&](const ContactView&) { ++found; });
        least = std::min(least, static_cast<double>(found) / static_cast<double>(expected));
    }
    return least;
}

Finding listing(bool quick) {
    Finding finding;
    finding.theory = finding.measured = 1;
    for (const double way : {0.001, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
        const double share = share_listed(way, quick ? 30 : 100);
        finding.curve.push_back({way, share, 1});
        finding.measured = std::min(finding.measured, share);
    }
    return finding;
}

}  // namespace

std::vector<Experiment> speed_experiments() {
    const auto loud = Failing::loud;
    return {{"tunnelling through a grain", "speed / ((r_i + r_j) sqrt(K1/m_eff))", loud,
             "health check; check warns from half of it on", through_each_other},
            {"through a wall", "speed / (2 r sqrt(K1/m))", loud, "health check; check warns before",
             through_a_wall},
            {"past each other in one step", "way of a step / (2 (r_i + r_j))", loud,
             "check warns from a tenth of a radius on", past_each_other},
            {"lists of fast grains", "share of touching pairs listed", Failing::silent,
             "lists are renewed before forces; no setting", listing}};
}

// Contacts that last too long for their drive: a deep bed moves like jelly on its plate, and a plate reverses
// its motion during an impact.

namespace {

using std::numbers::pi;

constexpr double kSpeed = 0.3;  // m/s, of an impact

// ---- a soft bed: the top of a column of elastic grains, shaken so gently that nothing comes apart ----

// Amplitude of the top divided by that of the plate: cos(q/2) / cos((n + 1/2) q) with sin(q/2) = (omega / 2)
// sqrt(m/K) (derived).
double chain_gain(int count, double omega) {
    const double q = 2 * math::asin(0.5 * omega * std::sqrt(bench_mass() / bench_stiffness));
    return math::cos(q / 2) / math::cos((count + 0.5) * q);
}

double measured_gain(int count, double omega) {
    constexpr int ramp = 12, looked_at = 4;
    const double unit = std::sqrt(bench_mass() / bench_stiffness), gravity = 9.81;
    const double period = 2 * pi / omega;
    const int steps = 8 * static_cast<int>(std::ceil(period / (0.05 * unit) / 8));
    SmallWorld world(latching_pair(bench_stiffness, 1), period / steps);
    world.plan.clock.steps_per_period = steps;
    Drive drive;
    drive.present = true;
    drive.frequency = 1 / period;
    drive.amplitude = 0.02 * gravity / (omega * omega);
    drive.ramp = ramp;
    world.add_floor();
    world.around.faces[0].body.driven = true;
    world.around.motion = DriveMotion(drive, world.plan.clock);
    world.around.gravity = {0, 0, -gravity};
    double z = -bench_radius;
    for (int k = 0; k < count; ++k) {
        const double weight = (count - k) * bench_mass() * gravity;
        z += 2 * bench_radius - weight / bench_stiffness;
        world.add(Vec3(0, 0, z));
    }
    world.start();
    world.run(static_cast<std::int64_t>(ramp) * steps);
    double by_sine = 0, by_cosine = 0;
    for (int k = 0; k < looked_at * steps; ++k) {
        world.run(1);
        const auto [sine, cosine] = math::sin_cos(2 * pi * k / steps);
        const double moved = world.position(count - 1).z() - z;
        by_sine += moved * sine, by_cosine += moved * cosine;
    }
    return 2 * math::hypot(by_sine, by_cosine) / (looked_at * steps) / drive.amplitude;
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
    finding.usual = 0.1 / pi;  // the plan keeps f h t_c <= 0.1 d, where t_c is about pi sqrt(m/K)
    return finding;
}

// ---- a plate that reverses its motion during an elastic impact; its top speed is the speed of the ball ----

double plate_velocity(double omega, double phase, double t) {
    return kSpeed * math::cos(omega * t + phase);
}

// Formula for the ball's velocity after the impact: y'' = -W^2 (y - a sin(wt + p)) + constant, until the ball
// no longer overlaps the plate.
double rebound_by_theory(double natural, double omega, double phase) {
    const double swing = kSpeed / omega * natural * natural / (natural * natural - omega * omega);
    const double start =
        kSpeed / omega * math::sin(phase);  // the plate's place at t = 0, which is subtracted
    const double a = start - swing * math::sin(phase);
    const double b = (-kSpeed - swing * omega * math::cos(phase)) / natural;
    const auto ball = [&](double t) {
        return a * math::cos(natural * t) + b * math::sin(natural * t) + swing * math::sin(omega * t + phase);
    };
    const auto apart = [&](double t) { return ball(t) - kSpeed / omega * math::sin(omega * t + phase); };
    double t = 1e-3 / natural;
    while (apart(t) < 0 && t < 100 / natural) t += 1e-3 / natural;
    return natural * (b * math::cos(natural * t) - a * math::sin(natural * t)) +
           swing * omega * math::cos(omega * t + phase);
}

double rebound_measured(double natural, double omega, double phase) {
    const double period = 2 * pi / omega;
    const auto steps = 8 * static_cast<std::int64_t>(std::ceil(period * natural / 0.01 / 8));
    SmallWorld world(latching_pair(bench_stiffness, 1), period / static_cast<double>(steps));
    world.plan.clock.steps_per_period = steps;
    world.plan.clock.initial_phase = phase / (2 * pi);
    Drive drive;
    drive.present = true;
    drive.frequency = 1 / period;
    drive.amplitude = kSpeed / omega;
    drive.phase = world.plan.clock.initial_phase;
    drive.ramp = 0;
    world.add_floor();
    world.around.faces[0].body.driven = true;
    world.around.motion = DriveMotion(drive, world.plan.clock);
    world.add(Vec3(0, 0, bench_radius), Vec3(0, 0, -kSpeed));
    world.start();
    bool touched = false;
    while (world.plan.clock.time(world.step) < 100 / natural) {
        world.run(1);
        const bool touches = world.grains.load[0].force.z() > 0;
        if (touched && !touches) break;
        touched |= touches;
    }
    return world.velocity(0).z();
}

// Error of the rebound at the worst phase of the drive, divided by the speed. The reference is a plate whose
// velocity does not change during the impact.
Finding drive_near_contact(bool quick) {
    constexpr double off = 0.1;
    const double natural = std::sqrt(bench_stiffness / bench_mass());
    const int phases = quick ? 8 : 24;
    const auto errors = [&](double share) {  // share: of a period of the drive that the contact time takes
        const double omega = 2 * natural * share;
        CurvePoint point{share, 0, 0};
        for (int k = 0; k < phases; ++k) {
            const double phase = 2 * pi * (k + 0.5) / phases, plate = plate_velocity(omega, phase, 0);
            const double closing = kSpeed + plate, rigid = kSpeed + 2 * plate;
            if (closing < 0.2 * kSpeed) continue;  // the ball would hardly hit the plate
            point.value =
                std::max(point.value, std::abs(rebound_measured(natural, omega, phase) - rigid) / kSpeed);
            point.theory =
                std::max(point.theory, std::abs(rebound_by_theory(natural, omega, phase) - rigid) / kSpeed);
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
    const auto silent = Failing::silent;
    return {{"soft column", "frequency x layers sqrt(m/K) where the top moves twice as far", silent,
             "the plan's stiffness; check warns of slow waves", soft_column},
            {"drive as fast as a contact", "frequency x time of a contact where the rebound is 10 % off",
             silent, "check warns", drive_near_contact}};
}

}  // namespace grainreel
