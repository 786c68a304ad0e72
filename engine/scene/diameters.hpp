// Diameters drawn from a species' spread.
#pragma once

#include "engine/base/random.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

double draw_diameter(const SizeSpread& spread, Random& random);  // m

}  // namespace grainreel
