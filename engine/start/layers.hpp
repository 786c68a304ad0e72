// Random centres in layers, one for each species, the biggest grains at the bottom, and radius growth that
// clears their overlaps. They correspond to init1, and to findrad, integ1 and integ2, of the original program
// (docs/notes/step.md).
#pragma once

#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// Returns all grains of the scene at rest. Ids count from 0 in the order of the species; diameters are
// drawn from the spread of each species. Centres are random in the species' layer, at least a quarter radius
// (in scenes with meshes half a radius) inside the container or the start's region, outside meshes and, where
// a place is found, outside glued grains. In thin layers and narrow rooms they may lie closer to walls.
// The layers divide the container's lower part in proportion to the solid volumes of the species, so all are
// equally dense. The species with the largest mean diameter lies lowest. The lower part is as high as a loose
// crowd of the grains needs (a third of its volume is solid), and at most the whole container. From higher up
// grains would only fall longer. Grains may overlap freely: radius growth removes that.
Grains place_in_layers(const Scene& scene);

// Radius growth: grains begin with radii that fit into the gaps and grow to their wanted radii, while the
// contact law pushes those that overlap apart.

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
