#include "render/app/estimate/engine_cost.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/lists.hpp"
#include "engine/base/numbers.hpp"
#include "engine/plan/plan_bed.hpp"
#include "engine/scene/bed.hpp"
#include "engine/start/settle.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/motion/scheme.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// What was fitted to measurements by processor time (docs/notes/performance.md, "Where the estimate of
// `check` misses"). Costs are relative to a step of a grain of the lattice.
struct FittedCosts {
    // Contacts of a grain in a bed at rest.
    double contacts_at_rest = 4.5, contacts_without_friction = 5.8;
    // In a shaken bed some contacts (thrown) remain at any strength. The others decrease exponentially with
    // the strength, at the rate falls_off.
    double thrown = 0.25, falls_off = 2.6;

    // A step of a grain without contacts, and what each contact adds.
    double grain = 0.23, grain_without_spin = 0.115, grain_of_gas = 0.15, contact = 0.165;
    double step = 4.2;  // a step without its grains
    // A step of a grain costs up to large_bed times as much in a bed that does not fit into the caches. The
    // factor grows with the logarithm of the number of grains, from small_bed_grains to kLargeBed grains.
    double large_bed = 1.5, small_bed_grains = 2000;

    double row = 3.7;           // a row of measures, for each grain
    double instrument = 2.5;    // what an instrument adds to a row
    double field_moment = 8.4;  // a moment of fields, for each grain
    // What the energy balance adds to a step: for a grain, and for each of its contacts.
    double balance = 0.3, balance_contact = 0.4;

    // Radii grow in about growing_steps steps. Then the bed falls and comes to rest (falling, in s, under
    // Earth's gravity). It counts as at rest after it has been calm for calm sqrt(diameter / g), as in
    // settle() (engine/start/settle.cpp). Without friction a bed takes longer, since it slides into closer
    // order: 0.63 s in all, 0.31 s with friction.
    double growing_steps = 8e3, falling = 0.28, falling_without_friction = 0.48, calm = 10;
};
constexpr FittedCosts fitted;

// Cost of a contact relative to the law of the lattice.
double contact_cost(const PairPlan& pair) {
    double cost = 1;
    if (pair.model.normal == NormalForce::spring_dashpot) cost = 0.62;
    if (pair.model.normal == NormalForce::hertz) cost = 0.75;
    if (pair.model.tangential == TangentialLaw::none) cost *= 0.35;
    if (pair.model.rolls) cost *= 1.27;
    return pair.model.precision == Precision::mixed ? 0.66 * cost : cost;
}

// The law that most contacts follow: the law of the commonest species.
const PairPlan& commonest(const FilmedScene& scene, const Plan& plan) {
    std::size_t most = 0;
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        if (scene.species[s].all() > scene.species[most].all()) most = s;
    return plan.between(most, most);
}

bool is_gas(const FilmedScene& scene) {
    return scene.gravity.norm() == 0;
}

bool rubs(const PairPlan& pair) {
    return pair.model.tangential != TangentialLaw::none;
}

// Cost of a grain's step relative to the lattice.
double grain_cost(const FilmedScene& scene, const Plan& plan, double contacts) {
    const PairPlan& pair = commonest(scene, plan);
    const double free = is_gas(scene) ? (rubs(pair) ? 1.0 : 0.5) * fitted.grain_of_gas
                        : rubs(pair)  ? fitted.grain
                                      : fitted.grain_without_spin;
    const auto forces = static_cast<double>(scheme_of(plan.integrator).stages.size());
    const double beyond =
        std::log(std::max(1.0, static_cast<double>(scene.grains()) / fitted.small_bed_grains)) /
        std::log(static_cast<double>(kLargeBed) / fitted.small_bed_grains);
    const double size = 1 + (fitted.large_bed - 1) * std::min(1.0, beyond);
    return (free + fitted.contact * contacts * contact_cost(pair)) * forces * size;
}

double contacts_at_rest(const FilmedScene& scene, const Plan& plan) {
    if (is_gas(scene)) return 0;
    return rubs(commonest(scene, plan)) ? fitted.contacts_at_rest : fitted.contacts_without_friction;
}

// Contacts of a grain in a shaken bed. level: the largest acceleration along gravity, divided by gravity.
double contacts_when_shaken(double at_rest, double level) {
    return level <= 1 ? at_rest
                      : fitted.thrown + (at_rest - fitted.thrown) * std::exp(-fitted.falls_off * (level - 1));
}

double level_along_gravity(const FilmedScene& scene, double frequency, double amplitude) {
    const Vec3 down = scene.gravity.normalized();
    const Drive of_stage{true, frequency, amplitude};
    return of_stage.g_level(scene.gravity.norm()) * std::abs(scene.drive.direction.dot(down));
}

double contacts_in_stage(const FilmedScene& scene, double at_rest, const DriveStage& stage) {
    if (stage.kind == DriveStage::Kind::rest) return at_rest;
    const double shaken =
        contacts_when_shaken(at_rest, level_along_gravity(scene, stage.frequency, stage.amplitude));
    if (stage.kind == DriveStage::Kind::vibrate) return shaken;
    // A tap lasts 1 / frequency, and the bed flies for as long after it.
    const double share = std::min(1.0, 2 / (stage.frequency * stage.interval));
    return at_rest + share * (shaken - at_rest);
}

// The mean number of contacts while the amplitude grows: the bed rests until the floor accelerates downwards
// faster than gravity.
double contacts_while_growing(double at_rest, double level) {
    constexpr int parts = 32;
    double sum = 0;
    for (int k = 0; k < parts; ++k)
        sum += contacts_when_shaken(at_rest, level * smooth_step::value((k + 0.5) / parts));
    return sum / parts;
}

// How many of the scene's grains are present, as a mean over the run.
double present(const FilmedScene& scene, const Plan& plan) {
    auto grains = static_cast<double>(scene.grains());
    const double end = scene.run.duration;
    for (const Feed& feed : scene.feeds) {
        const double until = std::min(feed.until.value_or(end), end);
        grains -= static_cast<double>(feed.due(end)) * std::clamp(0.5 * (feed.from + until) / end, 0.0, 1.0);
    }
    if (!plan.opens || scene.container.tray) return std::max(1.0, grains);
    constexpr double leave = 0.4;  // mean share of grains that leave, of those present when it opens
    const double open = 1 - static_cast<double>(*plan.opens) / static_cast<double>(plan.steps);
    return std::max(1.0, grains * (1 - leave * open));
}

double packing_cost(const FilmedScene& scene, const Plan& plan, double& steps) {
    if ((!scene.start.packs() && !plan.start.relaxes) || scene.grains_at_start() == 0) return 0;
    const auto grains = static_cast<double>(scene.grains_at_start());
    const double dense = grain_cost(scene, plan, contacts_at_rest(scene, plan));
    const double gravity = scene.gravity.norm();
    double settling = 0, arriving = fitted.growing_steps;
    if (gravity > 0)
        settling = fitted.calm * std::sqrt(mean_diameter(scene) / gravity) +
                   (rubs(commonest(scene, plan)) ? fitted.falling : fitted.falling_without_friction) *
                       std::sqrt(9.81 / gravity);
    if (plan.start.relaxes) {
        // A bed from a file that is relaxed comes to rest soon after its grains have been stopped.
        steps = static_cast<double>(braking_steps(plan)) + settling / plan.clock.step;
        return steps * (grains * dense + fitted.step);
    }
    // On average half of the grains are there while it rains.
    if (scene.start.method == Start::Method::rain)
        arriving = 0.5 * grains / rain_rate(scene) / plan.clock.step;
    steps = arriving + std::min(static_cast<double>(plan.settle_steps_limit), settling / plan.clock.step);
    return steps * (grains * dense + fitted.step);
}

double measuring_cost(const FilmedScene& scene, const Plan& plan, double grains, double contacts) {
    const auto steps = static_cast<double>(plan.steps);
    const std::vector<std::string> instruments = scene.instruments();
    const auto has = [&](const char* one) { return contains(instruments, one); };
    const bool balance = has("energy_balance");
    const double others = static_cast<double>(instruments.size()) - (balance ? 1 : 0);
    double cost =
        steps / static_cast<double>(plan.measures_every) * grains * (fitted.row + others * fitted.instrument);
    if (scene.output.fields.wanted()) cost += steps / plan.fields.every * grains * fitted.field_moment;
    const double look = fitted.step + grains * (fitted.balance + fitted.balance_contact * contacts);
    if (balance) cost += steps * look;
    if (has("wear")) cost += 0.5 * steps * look;  // at every second step
    return cost;
}

}  // namespace

double mean_contacts(const FilmedScene& scene, const Plan& plan) {
    const double at_rest = contacts_at_rest(scene, plan), end = scene.run.duration;
    if (is_gas(scene)) return 0;
    // Grains that run out are loose; grains that have run out lie still or are removed.
    const double flowing = plan.opens ? 0.5 : 1;
    if (!scene.drive.present) return flowing * at_rest;
    const Drive& drive = scene.drive;
    DriveStage now;
    now.frequency = drive.frequency;
    now.amplitude = drive.amplitude;
    double sum = 0, since = 0;
    // Grains that the scene lists one by one fall while the amplitude grows, with few contacts.
    if (drive.ramp > 0 && scene.start.method != Start::Method::grains) {
        const double level = level_along_gravity(scene, drive.frequency, drive.amplitude);
        since = std::min(end, drive.ramp / drive.frequency);
        sum = since * contacts_while_growing(at_rest, level);
    }
    for (std::size_t k = 0; k <= drive.stages.size(); ++k) {
        const double until = k < drive.stages.size() ? std::min(end, drive.stages[k].from) : end;
        sum += std::max(0.0, until - since) * contacts_in_stage(scene, at_rest, now);
        since = std::max(since, until);
        if (k < drive.stages.size()) now = drive.stages[k];
    }
    return flowing * sum / end;
}

EngineCost engine_cost(const FilmedScene& scene, const Plan& plan) {
    EngineCost cost;
    const double grains = present(scene, plan), contacts = mean_contacts(scene, plan);
    cost.packing = packing_cost(scene, plan, cost.packing_steps);
    cost.run_steps = static_cast<double>(plan.steps);
    cost.run = cost.run_steps * (grains * grain_cost(scene, plan, contacts) + fitted.step) +
               measuring_cost(scene, plan, grains, contacts);
    return cost;
}

}  // namespace grainreel
