// Relaxing: the bed of a start file, at rest under the laws of its own run, comes to rest under those of the
// scene, before the drive starts.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/start/settle.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

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
