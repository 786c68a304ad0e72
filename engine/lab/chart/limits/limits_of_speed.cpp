// Grains that are too fast: through each other, through a wall, past each other between two steps, and out of
// reach of the neighbour lists.
#include "engine/base/random.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/bench.hpp"
#include "engine/lab/chart/limits/experiment.hpp"

namespace grainreel {
namespace {

// Two equal grains head-on; `speed` over 2 r sqrt(K / m_eff), `step` over sqrt(m_eff / K). The speed after
// the meeting over that before, below zero where they went through each other.
double after_head_on(double speed, double step, double phase) {
    const double frequency = std::sqrt(bench_stiffness / (0.5 * bench_mass()));
    const double closing = speed * 2 * bench_radius * frequency, length = step / frequency;
    Bench bench(latching_pair(bench_stiffness, 1), length);
    const double apart = bench_radius + 0.5 * phase * closing * length;
    bench.add(Vec3(-apart, 0, 0), Vec3(0.5 * closing, 0, 0));
    bench.add(Vec3(apart, 0, 0), Vec3(-0.5 * closing, 0, 0));
    bench.start();
    while ((bench.position(1) - bench.position(0)).norm() < 2.5 * apart &&
           static_cast<double>(bench.step) < 100 / step)
        bench.run(1);
    return (bench.velocity(1) - bench.velocity(0)).x() / closing;
}

// m/s over 2 r sqrt(K1/m_eff): what the plan allows, overlap / diameter.
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

// A plane pushes a grain back from any depth; the health check stops a run at a depth of 2 r.
Finding through_a_wall(bool) {
    constexpr double steps = 200;  // of a quarter period
    Finding finding;
    finding.theory = 1;
    finding.usual = 0.02;  // overlap of 1 % of the diameter
    const double frequency = std::sqrt(bench_stiffness / bench_mass());
    const auto depth = [&](double speed) {
        Bench bench(latching_pair(bench_stiffness, 1), std::numbers::pi / 2 / frequency / steps);
        bench.add_floor();
        bench.add(Vec3(0, 0, bench_radius), Vec3(0, 0, -speed * 2 * bench_radius * frequency));
        bench.start();
        double deepest = 0;
        for (int k = 0; k < 2 * steps; ++k) {
            bench.run(1);
            deepest = std::max(deepest, bench_radius - bench.position(0).z());
        }
        return deepest / (2 * bench_radius);
    };
    for (const double speed : logarithmic(0.01, 2, 9)) finding.curve.push_back({speed, depth(speed), speed});
    finding.usual = usual_speed();
    finding.measured = last_that_holds(0.1, 2, 14, [&](double speed) { return depth(speed) < 1; });
    return finding;
}

// Nothing is seen of a meeting that lies between two steps: the chord is 2 (r_i + r_j) long.
Finding past_each_other(bool quick) {
    Finding finding;
    finding.theory = 1;
    const auto missed = [&](double chord) {  // a step's way over 2 (r_i + r_j), the share of phases missed
        constexpr double step = 1e-3;        // forces hardly matter here
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

// Grains of two sizes that fly through each other and a moving floor; `way`: of a step, over the skin. The
// smallest share of touching pairs and wall contacts that the loop has, over the steps.
double share_listed(double way, int steps) {
    constexpr double half = 0.012, step = 1e-5;
    Bench bench(latching_pair(1e-9, 1), step);
    bench.around.period = 2 * half;
    const double speed = way * bench.around.skin / step;
    Random random(7, Stream::centres);
    const auto anywhere = [&](double size) {
        return Vec3(random.between(-size, size), random.between(-size, size), random.between(-size, size));
    };
    for (int k = 0; k < 300; ++k)
        bench.add(anywhere(half), anywhere(speed), {k % 5 == 0 ? bench_radius : 0.4 * bench_radius});
    bench.add_plane(Vec3(0, 0, -half), Vec3(0, 0, 1));
    bench.around.faces[0].body.velocity = {0, 0, speed};
    bench.start();
    double least = 1;
    for (int k = 0; k < steps; ++k) {
        for (Place& p : bench.grains.place)  // kept in a box, by turning back what leaves it
            for (int axis = 1; axis < 3; ++axis)
                if (std::abs(p.position[axis]) > half) {
                    double& v = bench.grains.motion[&p - bench.grains.place.data()].velocity[axis];
                    v = std::copysign(v, -p.position[axis]);
                }
        bench.run(1);
        std::size_t expected = touching_by_search(bench.grains, bench.around.period), found = 0;
        for (const Place& p : bench.grains.place) {
            const Vec3 moved = bench.around.faces[0].displacement(bench.around.motion.at(bench.step));
            expected += distance_to(bench.around.faces[0], moved, p.position).distance < p.radius;
        }
        bench.loop->visit_contacts(bench.step, [&](const ContactView&) { ++found; });
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
    const auto loud = Failure::loud;
    return {{"tunnelling through a grain", "speed / ((r_i + r_j) sqrt(K1/m_eff))", loud,
             "health check; check warns from half of it on", through_each_other},
            {"through a wall", "speed / (2 r sqrt(K1/m))", loud, "health check; check warns before",
             through_a_wall},
            {"past each other in one step", "way of a step / (2 (r_i + r_j))", loud,
             "check warns from a tenth of a radius on", past_each_other},
            {"lists of fast grains", "share of touching pairs listed", Failure::silent,
             "lists are renewed before forces; no setting", listing}};
}

}  // namespace grainreel
