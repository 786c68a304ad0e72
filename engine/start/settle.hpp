// Settling: the grains fall under gravity into a loose packing at rest, before the drive starts.
#pragma once

#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct SettleReport {
    bool finished = true;  // false when the watcher stopped it
    bool settled = false;  // false when the scene's time limit came first
    std::int64_t steps = 0;
    double kinetic_per_grain = 0;  // J
};

// J: at rest means a mean kinetic energy a grain below max(1e-6 m g d, 5 (m g)^2 / K1) for 10 sqrt(d / g),
// with the means of mass and diameter over the grains and the softest wall contact.
double rest_energy(const Plan& plan, const Grains& grains, double gravity);

// Runs with still walls, the scene's own laws and its extra settling drag. watcher(share of the time limit,
// steps): false stops.
SettleReport settle(const Scene& scene, const Plan& plan, const Surroundings& surroundings, Grains& grains,
                    StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher);

}  // namespace grainreel
