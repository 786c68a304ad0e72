// Radius growth: grains begin with radii that fit into the gaps and grow to their wanted radii, while the
// contact law pushes those that overlap apart. It corresponds to findrad, integ1 and integ2 of the original
// program (docs/notes/step.md).
#pragma once

#include <cstdint>
#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct GrowthReport {
    std::int64_t steps = 0;
    std::int64_t cycles = 0;
    bool finished = true;  // false when the watcher stopped it
};

// Takes the wanted radii from `grains` and returns with exactly those, at rest, without any overlap between
// grains or with walls. Throws RunError when the grains do not come apart (too many for the container).
// watcher gets the share of the wanted radii reached and the steps so far; it stops the growth by returning
// false.
GrowthReport grow_radii(const Scene& scene, const Plan& plan, const Surroundings& surroundings,
                        Grains& grains, Team& team, const std::function<bool(double, std::int64_t)>& watcher);

}  // namespace grainreel
