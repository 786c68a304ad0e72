// Round-off: a bead at rest on a plate sinks in by m g / K. When a unit in the last place of its position is
// as large as that, the contact force is a lottery. 3 mm glass at 0.3 m from the origin, as in a hopper.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/lab/chart/bench.hpp"
#include "engine/lab/chart/limits/experiment.hpp"

namespace grainreel {
namespace {

constexpr double height = 0.3, radius = 0.0015, gravity = 9.81;  // m, m, m/s2

double weight() {
    return sphere_mass_of(radius) * gravity;
}

// m: of a position at `height`.
double last_place(bool in_single) {
    return in_single ? std::nextafter(static_cast<float>(height), 1.0F) - static_cast<float>(height)
                     : std::nextafter(height, 1.0) - height;
}

// |N / (m g) - 1| of a bead at rest, on a spring with a dashpot: root mean square over time, on a plate
// `shift` of a last place higher.
double force_error(double stiffness, bool in_single, double shift) {
    const double mass = sphere_mass_of(radius), natural = std::sqrt(stiffness / mass);
    PairPlan pair;
    pair.model = {NormalForce::spring_dashpot, TangentialLaw::none};
    pair.loading_stiffness = pair.unloading_stiffness = stiffness;
    pair.normal_damping = natural;
    Bench bench(pair, 0.1 / natural);
    bench.around.gravity = {0, 0, -gravity};
    const double plate = height + shift * last_place(in_single);
    bench.add_plane(Vec3(0, 0, plate), Vec3(0, 0, 1));
    bench.add(Vec3(0, 0, plate + radius - weight() / stiffness), Vec3::Zero(), {radius, bench_density});
    bench.start();
    constexpr int settling = 3000, looked_at = 3000;
    double squares = 0;
    for (int k = 0; k < settling + looked_at; ++k) {
        bench.run(1);
        double& z = bench.grains.place[0].position.z();
        if (in_single) z = static_cast<float>(z);
        if (k < settling) continue;
        const double overlap = radius - (z - plate);
        squares += std::pow(stiffness * std::max(0.0, overlap) / weight() - 1, 2);
    }
    return std::sqrt(squares / looked_at);
}

double worst_error(double stiffness, bool in_single) {
    double worst = 0;
    for (double shift = 0; shift < 1; shift += 0.125)
        worst = std::max(worst, force_error(stiffness, in_single, shift));
    return worst;
}

// The stiffness at which the force is off by half of itself; theory: half a last place is half the overlap.
Finding rounding(bool in_single) {
    Finding finding;
    const double limit = weight() / last_place(in_single);  // N/m
    for (const double share : logarithmic(1e-4, 30, 12))
        finding.curve.push_back({share * limit, worst_error(share * limit, in_single), 0.5 * share});
    finding.theory = limit;
    finding.measured =
        limit * std::exp(last_that_holds(std::log(1e-3), std::log(30.0), 12, [&](double share) {
            return worst_error(std::exp(share) * limit, in_single) < 0.5;
        }));
    finding.usual = 2e4;
    return finding;
}

}  // namespace

std::vector<Experiment> number_experiments() {
    return {{"rounding in single precision", "stiffness in N/m", Failure::silent,
             "the engine computes in double", [](bool) { return rounding(true); }},
            {"rounding in double precision", "stiffness in N/m", Failure::silent, "check warns",
             [](bool) { return rounding(false); }}};
}

}  // namespace grainreel
