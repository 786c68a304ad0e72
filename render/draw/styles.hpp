// The three lights: studio, flat, dark.
#pragma once

#include "engine/scene/film_look.hpp"
#include "render/spheres/lamp.hpp"

namespace grainreel {

Lamp lamp_of(const FilmLook& look);

}  // namespace grainreel
