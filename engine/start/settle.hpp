// Settling: the grains fall under gravity into a loose packing at rest, before the drive starts. Relaxing:
// a bed at rest from a file adapts to the laws of the scene.
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

// The bound (J) of the mean kinetic energy of a grain at rest: max(1e-6 m g d, 5 (m g)^2 / K1), with mean
// mass and diameter of the grains and the softest wall contact. The bed rests when it stays below for 10
// sqrt(d / g).
double rest_energy(const Plan& plan, const Grains& grains, double gravity);

// Runs with still walls, the scene's own laws and its extra settling drag. watcher gets the share of the
// time limit and the steps; it stops by returning false.
SettleReport settle(const Scene& scene, const Plan& plan, const Surroundings& surroundings, Grains& grains,
                    StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher);

// Relaxing: the bed of a start file rests under the laws of its own run, and comes to rest under those of
// the scene before the drive starts.

// A bed that only has to change its overlaps comes to rest within this time (s).
constexpr double kRelaxLimit = 2;

// Number of steps before the first one of settle(). In these a drag stops whatever a step sets in motion,
// and becomes weaker little by little. So overlaps find the forces that carry the weight, and nothing
// jumps.
std::int64_t braking_steps(const Plan& plan);

// Runs with still walls and the scene's own laws: first braking, then settle() with the plan's limit.
// `settled` is false where the bed did not come to rest, or where a grain in a hundred has moved by more
// than half its diameter. Then the bed did not rest in this scene, and the caller has to take the grains as
// they were.
SettleReport relax(const Scene& scene, const Plan& plan, const Surroundings& surroundings, Grains& grains,
                   StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher);

}  // namespace grainreel
