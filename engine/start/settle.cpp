#include "engine/start/settle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/measure/energy.hpp"
#include "engine/measure/health.hpp"
#include "engine/start/fallen.hpp"

namespace grainreel {

namespace {

constexpr std::int64_t kStepsPerLook = 200;

}  // namespace

double rest_energy(const Plan& plan, const Grains& grains, double gravity) {
    double mass = 0, diameter = 0, softest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grains.size(); ++i) {
        mass += grains.mass(i);
        diameter += 2 * grains.place[i].radius;
    }
    mass /= static_cast<double>(grains.size());
    diameter /= static_cast<double>(grains.size());
    for (const std::vector<PairPlan>* walls : {&plan.wall, &plan.glued, &plan.mesh})
        for (const PairPlan& wall : *walls) softest = std::min(softest, wall.loading_stiffness);
    const double weight = mass * gravity;
    return std::max(1e-6 * weight * diameter, 5 * weight * weight / softest);
}

SettleReport settle(const Scene& scene, const Plan& plan, const Surroundings& surroundings, Grains& grains,
                    StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher) {
    SettleReport report;
    const double gravity = surroundings.gravity.norm();
    if (gravity == 0 || plan.settle_steps_limit == 0 || grains.size() == 0) {
        report.settled = true;
        return report;
    }
    const double rest = rest_energy(plan, grains, gravity);
    double diameter = 0;
    for (const Place& p : grains.place) diameter += 2 * p.radius / static_cast<double>(grains.size());
    const std::int64_t calm_steps =
        static_cast<std::int64_t>(10 * std::sqrt(diameter / gravity) / plan.clock.step);
    const HealthLimits limits = health_limits(scene, plan);
    const FallenGrains fallen(scene, surroundings);
    std::int64_t calm_since = -1;
    // Steps count from -limit: walls stand still before step 0.
    const std::int64_t first = -plan.settle_steps_limit;
    while (report.steps < plan.settle_steps_limit) {
        const std::int64_t now = std::min(kStepsPerLook, plan.settle_steps_limit - report.steps);
        loop.run(first + report.steps, now, plan.clock.step, scene.start.settle_damping);
        report.steps += now;
        fallen.stop(grains);
        check_state(limits, surroundings, grains, loop, first + report.steps);
        const Kinetic kinetic = kinetic_energy(grains);
        report.kinetic_per_grain =
            (kinetic.translation + kinetic.rotation) / static_cast<double>(grains.size());
        if (report.kinetic_per_grain > rest)
            calm_since = -1;
        else if (calm_since < 0)
            calm_since = report.steps;
        if (calm_since >= 0 && report.steps - calm_since >= calm_steps) {
            report.settled = true;
            return report;
        }
        if (!watcher(static_cast<double>(report.steps) / static_cast<double>(plan.settle_steps_limit),
                     report.steps)) {
            report.finished = false;
            return report;
        }
    }
    return report;
}

namespace {

constexpr double kContactsALevel = 20;  // contact times for which each drag lasts
constexpr double kFarthest = 0.5;       // diameters by which a grain may move
constexpr double kFew = 0.01;           // share of the grains that may move farther

struct Level {
    double drag = 0;  // 1/s
    std::int64_t steps = 0;
};

// The duration (s) of the shortest contact.
double contact_time(const Plan& plan) {
    double quickest = std::numeric_limits<double>::infinity();
    for (const std::vector<PairPlan>* kinds : {&plan.grain, &plan.wall, &plan.glued, &plan.mesh})
        for (const PairPlan& pair : *kinds) quickest = std::min(quickest, pair.contact_time);
    return quickest;
}

// A falling series of drags, each half of the one before: from one under which no contact swings to one as
// weak as that of settle().
std::vector<Level> levels_of(const Plan& plan) {
    constexpr double kWeakest = 20;  // 1/s
    const double time = contact_time(plan);
    std::vector<Level> levels;
    for (double drag = 2 * std::numbers::pi / time; drag > kWeakest; drag /= 2)
        levels.push_back({drag, std::llround(std::ceil(kContactsALevel * time / plan.clock.step))});
    return levels;
}

std::vector<Vec3> places_by_id(const Grains& grains) {
    std::vector<Vec3> places(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) places[grains.id[i]] = grains.place[i].position;
    return places;
}

bool stayed(const std::vector<Vec3>& before, const Grains& grains) {
    double moved = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Vec3 way = grains.place[i].position - before[grains.id[i]];
        moved += way.norm() > kFarthest * 2 * grains.place[i].radius;
    }
    return moved <= kFew * static_cast<double>(grains.size());
}

}  // namespace

std::int64_t braking_steps(const Plan& plan) {
    std::int64_t steps = 0;
    for (const Level& level : levels_of(plan)) steps += level.steps;
    return steps;
}

SettleReport relax(const Scene& scene, const Plan& plan, const Surroundings& surroundings, Grains& grains,
                   StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher) {
    const std::vector<Vec3> before = places_by_id(grains);
    const HealthLimits limits = health_limits(scene, plan);
    const FallenGrains fallen(scene, surroundings);
    const std::int64_t braking = braking_steps(plan);
    const double all = static_cast<double>(braking + plan.settle_steps_limit);
    SettleReport report;
    for (const Level& level : levels_of(plan)) {
        const std::int64_t at = report.steps - braking - plan.settle_steps_limit;
        loop.run(at, level.steps, plan.clock.step, level.drag);
        report.steps += level.steps;
        fallen.stop(grains);
        check_state(limits, surroundings, grains, loop, at + level.steps);
        if (watcher(static_cast<double>(report.steps) / all, report.steps)) continue;
        report.finished = false;
        return report;
    }
    const SettleReport settled =
        settle(scene, plan, surroundings, grains, loop, [&](double, std::int64_t steps) {
            return watcher(static_cast<double>(braking + steps) / all, braking + steps);
        });
    report.finished = settled.finished;
    report.kinetic_per_grain = settled.kinetic_per_grain;
    report.steps += settled.steps;
    report.settled = settled.settled && stayed(before, grains);
    return report;
}

}  // namespace grainreel
