// Settling: the grains fall under gravity into a loose packing at rest, before the drive starts.
#pragma once

#include <cstdint>
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

// Relaxing: the bed of a start file, at rest under the laws of its own run, comes to rest under those of the
// scene, before the drive starts.

// s: no bed needs longer that comes to rest by changes of its overlaps alone.
constexpr double kRelaxLimit = 2;

// Steps before the first one of settle(): a drag that stops whatever a step sets in motion, and becomes
// weaker by and by. So overlaps find the forces that carry the weight, and nothing jumps.
std::int64_t braking_steps(const Plan& plan);

// Runs with still walls and the scene's own laws: braking, then settle() with the plan's limit. settled is
// false where the bed did not come to rest, or a grain in a hundred has moved by more than half its diameter:
// then it did not rest in this scene, and the caller has to take the grains as they were.
SettleReport relax(const Scene& scene, const Plan& plan, const Surroundings& surroundings, Grains& grains,
                   StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher);

}  // namespace grainreel
