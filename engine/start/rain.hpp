// A start by rain: grains appear one after the other above the bed, fall on it and come to rest.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct RainReport {
    bool finished = true;  // false when the watcher stopped it
    std::int64_t steps = 0;
};

// Lets all grains of the scene rain into the container at rest, at rain_rate(). The species come mixed at
// random, in proportion to their counts. A grain appears at rest at a random place in a layer above the bed,
// where it touches nothing; the layer rises with the bed. `grains` are empty and `loop` is theirs.
// watcher: the share that has come, and the steps so far; false stops.
// Throws RunError when the grains find no room.
RainReport rain(const Scene& scene, const Plan& plan, const Surroundings& around, Grains& grains,
                StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher);

}  // namespace grainreel
