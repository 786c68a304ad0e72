// Random centres in layers, one a species, big at the bottom (init1 of the original program).
#pragma once

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// All grains of the scene at rest: ids counting from 0 in the order of the species, diameters drawn from each
// species' spread, centres at random in the species' layer, at least a quarter radius (half of one beside
// meshes) inside the container (or the start's region) and outside of meshes and of grains glued to walls.
// The layers share the container's lower part as the species share the solid volume, so all are equally
// dense; the species with the largest mean diameter lies lowest. That part is as high as a loose crowd needs
// (a third of its volume is solid), or the whole container: from higher up grains would only fall longer.
// Spheres overlap freely: radius growth sorts that out.
Grains place_in_layers(const Scene& scene);

}  // namespace grainreel
