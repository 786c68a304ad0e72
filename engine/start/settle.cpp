#include "engine/start/settle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/measure/energy/energy.hpp"
#include "engine/measure/health.hpp"

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
    std::int64_t calm_since = -1;
    // Steps count from -limit, so that the walls, which stand before step 0, stand still.
    const std::int64_t first = -plan.settle_steps_limit;
    while (report.steps < plan.settle_steps_limit) {
        const std::int64_t now = std::min(kStepsPerLook, plan.settle_steps_limit - report.steps);
        loop.run(first + report.steps, now, plan.clock.step, scene.start.settle_damping);
        report.steps += now;
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

}  // namespace grainreel
