// Radius expansion (findrad, integ1 and integ2 of the original program): grains grow from what the gaps allow
// to their wanted radii, while overlaps push apart through the contact law.
#pragma once

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
// watcher(share of the wanted radii reached, steps so far): false stops.
GrowthReport grow_radii(const Scene& scene, const Plan& plan, const Surroundings& surroundings,
                        Grains& grains, Team& team, const std::function<bool(double, std::int64_t)>& watcher);

}  // namespace grainreel
