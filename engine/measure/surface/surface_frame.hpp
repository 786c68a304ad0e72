// Where the surface of a scene's bed is looked for.
#pragma once

#include "engine/measure/surface/surface.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The frame of the container at rest, as wide as it is free at the height that the grains fill. Bins go by
// the mean diameter of all grains. It has no width in empty space, nor in a drum (drum_surface.hpp).
SurfaceFrame surface_frame(const Scene& scene);

}  // namespace grainreel
