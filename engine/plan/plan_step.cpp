// The time step: short compared with every contact, and stable for a grain with twelve neighbours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/plan/plan_parts.hpp"

namespace grainreel {
namespace {

// The step times the angular frequency of a free pair. It stays well below the stable limit, so that the
// stiffest branch of a law is followed too.
constexpr double pair_share = std::numbers::pi / 2 / 2.75;
// The step times the angular frequency of the bed's fastest mode. That mode matters only for stability, not
// for accuracy.
constexpr double bed_share = 1.2;
// Factors on the step at which dashpots would let the motion grow. Sideways, Coulomb's law limits their
// force, and no bed has twelve contacts for each grain: 300 grains of e = 0.165 blew up only from 2.4 times
// that step on.
constexpr double damped_share = 0.6, damped_sideways_share = 1.7;

std::string pair_name(const Scene& scene, std::size_t a, std::size_t b) {
    return scene.species[a].name + "-" + (b < scene.species.size() ? scene.species[b].name : "wall");
}

const PairPlan& pair_of(const Plan& plan, std::size_t a, std::size_t b) {
    return b < plan.wall.size() ? plan.between(a, b) : plan.wall[a];
}

double share_of(double step, double omega) {
    return omega > 0 ? step / omega : std::numeric_limits<double>::infinity();
}

// The tangential stiffness that acts: without friction the spring carries nothing and adds no mode.
double tangential_stiffness(const PairPlan& pair) {
    return pair.friction > 0 ? pair.tangential_stiffness : 0;
}

// Damping constant (kg/s) of the normal dashpot between two bodies of this effective mass. Hertz' dashpot
// grows as a^(1/4). It is taken at an eighth of the allowed overlap, which few contacts of a bed pass; K =
// 3/2 k sqrt(a) is taken at the allowed overlap.
double normal_dashpot(const PairPlan& pair, double mass) {
    if (pair.modulus > 0)
        return pair.hertz_damping * std::sqrt(mass * pair.loading_stiffness / 1.5 / std::sqrt(8));
    return pair.damping_rate(mass) * mass;
}
double tangential_dashpot(const PairPlan& pair, double mass) {
    if (pair.friction == 0) return 0;
    if (pair.modulus > 0) return std::sqrt(pair.tangential_ratio) * normal_dashpot(pair, mass);
    return pair.tangential_damping_rate(mass) * mass;
}

// The fastest mode of a grain of mass m among twelve others, of which at most three are walls, or six are
// parts of rough walls. omega^2 is 8 K2 / m without friction, and 40 K0 / m with spin coupled in
// (Gerschgorin's bound of the stiffness matrix); dashpots give 8 C / m and 40 C / m by the same bound.
struct Mode {
    double omega2 = 0, damping = 0;  // 1/s2, 1/s
};
struct BedModes {
    Mode normal, sideways;
    double fastest() const { return std::sqrt(std::max(normal.omega2, sideways.omega2)); }
};

// `mass` is that of one grain. `of` gives what one contact adds, from its numbers and its effective mass.
BedModes bed_modes(const Scene& scene, const Plan& plan, std::size_t species, double mass) {
    const auto most = [&](const auto& of) {
        double among = 0, at_wall = of(plan.wall[species], mass);
        for (std::size_t other = 0; other < plan.wall.size(); ++other) {
            const Species& partner = scene.species[other];
            const double heavy = mass_of(partner, partner.diameter.largest);
            among = std::max(among, of(plan.between(species, other), mass * heavy / (mass + heavy)));
        }
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            at_wall = std::max(at_wall, of(plan.at_mesh(m, species), mass));
        if (!plan.glued.empty()) at_wall = std::max(at_wall, of(plan.glued[species], mass));
        const double walls = plan.glued.empty() ? 0.25 : 0.5;
        return (1 - walls) * among + walls * std::max(among, at_wall);
    };
    BedModes modes;
    using P = PairPlan;
    modes.normal.omega2 = 8 * most([](const P& p, double) { return p.unloading_stiffness; }) / mass;
    modes.sideways.omega2 = 40 * most([](const P& p, double) { return tangential_stiffness(p); }) / mass;
    modes.normal.damping = 8 * most(normal_dashpot) / mass;
    modes.sideways.damping = 40 * most(tangential_dashpot) / mass;
    return modes;
}

// The longest step (s) with dashpots. A dashpot uses the velocity of earlier steps and knows only its own
// contact. Where many act on a grain, (omega dt / limit)^2 + damping dt <= 1 keeps the mode from growing.
// (The recurrence of the scheme was tried for two to sixteen contacts and damping ratios from 0.01 to 20: it
// grows from 1.02 to 1.3 on.)
double damped_limit(const Mode& mode, double limit) {
    if (mode.omega2 == 0) return share_of(1, mode.damping);
    const double rate = mode.omega2 / (limit * limit), half = 0.5 * mode.damping;
    return (std::sqrt(half * half + rate) - half) / rate;
}

}  // namespace

bool nearly_elastic(double restitution) {
    return 1 - restitution * restitution < math::pow(std::numbers::pi / 12, 4);
}

// Walton-Braun: n = 9.5 - 8 ln e steps, at least 12, keep the error of the restitution below 0.005 for e >=
// 0.08 (0.0020 at e = 0.9). This was measured over e and 200 onset phases; tests/scene integrates it.
// Without corrections it holds for whole n only, where the errors of onset and exit cancel; at n = 12.5
// they leave 0.008.
// Spring-dashpot: the force jumps when the grains meet, which leaves an error of first order. 45 steps
// leave 0.003 at e = 0.9 and 0.013 at worst, and 0.005 and 0.016 where the dashpot may pull. With Hertz, 45
// steps keep the energy of a vibrated bed to 0.1 %, and 40 do not.
// Nearly elastic grains of any law have 45 steps too: plain Verlet then gains and loses at most (w dt)^2 /
// 4 of an impact's energy, by the phases of touch and exit, and an elastic gas drifts as with a
// spring-dashpot.
int steps_per_contact(NormalForce law, double restitution, Accuracy accuracy) {
    const double more = accuracy == Accuracy::draft ? 0.7 : accuracy == Accuracy::reference ? 4 : 1;
    const bool dashpot = law == NormalForce::spring_dashpot || law == NormalForce::hertz;
    const double standard = dashpot || nearly_elastic(restitution)
                                ? 45
                                : std::max(12.0, std::ceil(9.5 - 8 * math::log(restitution)));
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
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            demand_of(plan.at_mesh(m, a), scene.species[a].name + "-" + scene.meshes[m].name);
        const Species& species = scene.species[a];
        const double mass = species.density * std::numbers::pi / 6 * math::cube(species.diameter.smallest);
        const BedModes dense = bed_modes(scene, plan, a, mass);
        const double normal = damped_limit(dense.normal, limit),
                     sideways = damped_sideways_share * damped_limit(dense.sideways, limit);
        demand(share_of(bed_share, dense.fastest()),
               fmt::format("stability of \"{}\" among twelve neighbours", species.name));
        demand(std::min(damped_share * normal, sideways),
               fmt::format("dashpots of \"{}\" among twelve neighbours", species.name));
        choice.stable = std::min({choice.stable, share_of(limit, dense.fastest()), normal, sideways});
    }
    if (scene.run.step) {
        choice.step = *scene.run.step;
        choice.reason = "the scene";
    }
    return choice;
}

}  // namespace grainreel
