// Takes grains that are ellipsoids or superquadrics into view coordinates.
#pragma once

#include "engine/state/state.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/spheres/light/sphere_layer.hpp"

namespace grainreel {

// Replaces the spheres of the frame's grains by their shapes and by the balls that take light in their place.
// Grains that come after them in `spheres` are spheres, and get shapes too. Does nothing where all grains are
// spheres. Called when all else is in `spheres`.
void give_shapes(const View& view, const State& frame, Spheres& spheres);

}  // namespace grainreel
