#include "engine/start/relax.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/measure/health.hpp"

namespace grainreel {

namespace {

constexpr double kContactsALevel = 20;  // contact times that each drag lasts
constexpr double kFarthest = 0.5;       // of a diameter
constexpr double kFew = 0.01;           // of the grains

struct Level {
    double drag = 0;  // 1/s
    std::int64_t steps = 0;
};

// s: of the quickest contact.
double contact_time(const Plan& plan) {
    double quickest = std::numeric_limits<double>::infinity();
    for (const std::vector<PairPlan>* kinds : {&plan.grain, &plan.wall, &plan.glued, &plan.mesh})
        for (const PairPlan& pair : *kinds) quickest = std::min(quickest, pair.contact_time);
    return quickest;
}

// From a drag under which no contact swings down to one that settle() has, by halves.
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
    for (std::size_t i = 0; i < grains.size(); ++i)
        places[static_cast<std::size_t>(grains.id[i])] = grains.place[i].position;
    return places;
}

bool stayed(const std::vector<Vec3>& before, const Grains& grains) {
    double moved = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Vec3 way = grains.place[i].position - before[static_cast<std::size_t>(grains.id[i])];
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
    const std::int64_t braking = braking_steps(plan);
    const double all = static_cast<double>(braking + plan.settle_steps_limit);
    SettleReport report;
    for (const Level& level : levels_of(plan)) {
        const std::int64_t at = report.steps - braking - plan.settle_steps_limit;
        loop.run(at, level.steps, plan.clock.step, level.drag);
        report.steps += level.steps;
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
