// Colour maps for numbers, safe for the colour-blind.
#pragma once

#include "render/scene/film_shows.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// sRGB; share: 0 at the map's low end, 1 at its high end, held beyond.
Colour colour_of(ColourMap map, double share);

}  // namespace grainreel
