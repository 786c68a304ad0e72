// Random centres in layers, one for each species, the biggest grains at the bottom: init1 of the original
// program (docs/notes/step.md). Radius growth clears their overlaps.
#pragma once

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

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

}  // namespace grainreel
