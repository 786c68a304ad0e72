// The time step: short against every contact, and stable for a grain with twelve neighbours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/plan/plan_parts.hpp"

namespace grainreel {
namespace {

// Free pairs keep well below the stable limit, so that the stiffest branch is followed too.
constexpr double pair_share = std::numbers::pi / 2 / 2.75;
// A dense bed has its own fastest mode; it decides over stability only, not over accuracy.
constexpr double bed_share = 1.2;

std::string pair_name(const Scene& scene, std::size_t a, std::size_t b) {
    return scene.species[a].name + "-" + (b < scene.species.size() ? scene.species[b].name : "wall");
}

const PairPlan& pair_of(const Plan& plan, std::size_t a, std::size_t b) {
    return b < plan.wall.size() ? plan.between(a, b) : plan.wall[a];
}

double share_of(double step, double omega) {
    return omega > 0 ? step / omega : std::numeric_limits<double>::infinity();
}

// What acts: a spring that may carry nothing adds no mode.
double tangential_stiffness(const PairPlan& pair) {
    return pair.friction > 0 ? pair.tangential_stiffness : 0;
}

// omega^2 of the fastest mode of a grain among twelve others, three of them walls at most, or six of them
// parts of rough walls: 8 K2 / m without friction, 40 K0 / m with spin coupled in (Gerschgorin's bound of the
// stiffness matrix).
double bed_frequency(const Plan& plan, std::size_t species, double mass) {
    double unloading = 0, tangential = 0;
    for (std::size_t other = 0; other < plan.wall.size(); ++other) {
        unloading = std::max(unloading, plan.between(species, other).unloading_stiffness);
        tangential = std::max(tangential, tangential_stiffness(plan.between(species, other)));
    }
    double at_wall = plan.wall[species].unloading_stiffness;
    double along_wall = tangential_stiffness(plan.wall[species]);
    if (!plan.glued.empty()) {
        at_wall = std::max(at_wall, plan.glued[species].unloading_stiffness);
        along_wall = std::max(along_wall, tangential_stiffness(plan.glued[species]));
    }
    const double walls = plan.glued.empty() ? 0.25 : 0.5;
    const double normal = (1 - walls) * unloading + walls * std::max(unloading, at_wall);
    const double sideways = (1 - walls) * tangential + walls * std::max(tangential, along_wall);
    return std::sqrt(std::max(8 * normal, 40 * sideways) / mass);
}

}  // namespace

bool nearly_elastic(double restitution) {
    return 1 - restitution * restitution < std::pow(std::numbers::pi / 12, 4);
}

// Walton-Braun: measured over e and 200 onset phases, n = 9.5 - 8 ln e, at least 12, keeps the error of the
// restitution below 0.005 for e >= 0.08 (0.0020 at e = 0.9; tests/scene integrates it). Without corrections
// that holds for whole n only: onset and exit errors then cancel, at n = 12.5 they leave 0.008. The
// spring-dashpot's force jumps when the grains meet, which leaves an error of first order: 45 steps leave
// 0.003 at e = 0.9 and 0.013 at worst, 0.005 and 0.016 where the dashpot may pull. They keep the energy of a
// vibrated bed to 0.1 %, which 40 do not with
// Hertz. Nearly elastic grains of any law have as many: plain Verlet then gains and loses (w dt)^2 / 4 of an
// impact's energy at most, by the phases of touch and exit, and an elastic gas drifts as with a
// spring-dashpot.
int steps_per_contact(NormalForce law, double restitution, Accuracy accuracy) {
    const double more = accuracy == Accuracy::draft ? 0.7 : accuracy == Accuracy::reference ? 4 : 1;
    const bool dashpot = law == NormalForce::spring_dashpot || law == NormalForce::hertz;
    const double standard = dashpot || nearly_elastic(restitution)
                                ? 45
                                : std::max(12.0, std::ceil(9.5 - 8 * std::log(restitution)));
    return static_cast<int>(std::ceil(more * standard));
}

double stable_step(Integrator integrator) {
    if (integrator == Integrator::gear) return std::numbers::sqrt2;
    return integrator == Integrator::forest_ruth ? 2.99 : 2;
}

StepChoice plan_step(const Scene& scene, const Plan& plan) {
    StepChoice choice;
    choice.step = choice.stable = std::numeric_limits<double>::infinity();
    const auto demand = [&](double step, const std::string& reason) {
        if (step < choice.step) {
            choice.step = step;
            choice.reason = reason;
        }
    };
    const double limit = stable_step(plan.integrator);
    const auto demand_of = [&](const PairPlan& pair, const std::string& name) {
        const int steps = scene.run.steps_per_contact.value_or(
            steps_per_contact(pair.model.normal, pair.restitution, scene.run.accuracy));
        demand(pair.contact_time / steps, fmt::format("{} steps in a contact {}", steps, name));
        const double unloading = std::sqrt(pair.unloading_stiffness / pair.effective_mass);
        const double sideways = std::sqrt(3.5 * tangential_stiffness(pair) / pair.effective_mass);
        demand(share_of(pair_share, unloading), "unloading of a contact " + name);
        demand(share_of(pair_share, sideways), "tangential spring of a contact " + name);
        choice.stable = std::min(choice.stable, share_of(limit, std::max(unloading, sideways)));
    };
    const std::size_t count = plan.wall.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b <= count; ++b) demand_of(pair_of(plan, a, b), pair_name(scene, a, b));
        if (!plan.glued.empty()) demand_of(plan.glued[a], scene.species[a].name + "-glued grain");
        const Species& species = scene.species[a];
        const double mass = species.density * std::numbers::pi / 6 * std::pow(species.diameter.smallest, 3);
        const double dense = bed_frequency(plan, a, mass);
        demand(share_of(bed_share, dense),
               fmt::format("stability of \"{}\" among twelve neighbours", species.name));
        choice.stable = std::min(choice.stable, share_of(limit, dense));
    }
    if (scene.run.step) {
        choice.step = *scene.run.step;
        choice.reason = "the scene";
    }
    return choice;
}

}  // namespace grainreel
