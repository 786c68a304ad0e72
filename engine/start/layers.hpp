// Random centres in layers, one a species, big at the bottom (init1 of the original program).
#pragma once

#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// All grains of the scene at rest: ids counting from 0 in the order of the species, diameters drawn from each
// species' spread, centres at random in the species' layer, at least a quarter radius (half of one beside
// meshes) inside the container (or the start's region) and outside of meshes and of grains glued to walls.
// The layers share the container's lower part as the species share the solid volume, so all are equally
// dense; the species with the largest mean diameter lies lowest. That part is as high as a loose crowd needs
// (a third of its volume is solid), or the whole container: from higher up grains would only fall longer.
// Spheres overlap freely: radius growth sorts that out.
Grains place_in_layers(const Scene& scene);

// Radius expansion (findrad, integ1 and integ2 of the original program): grains grow from what the gaps allow
// to their wanted radii, while overlaps push apart through the contact law.

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
