// A single large grain in a bed of others.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Index of the one grain of the species of the largest mean diameter; none where there is one species only,
// or that species has not just one grain.
std::optional<std::size_t> find_intruder(const Scene& scene, const Grains& grains);

// Height of the intruder's top over that of the bed's surface around it, both above the floor: 1 when it
// comes to the surface. The surface is that of the other grains (surface.hpp) in a square around the intruder
// which reaches two of their mean diameters beyond it. NaN without other grains there.
double intruder_height(const Scene& scene, const Grains& grains, std::size_t intruder, double floor);

}  // namespace grainreel
