// The three lights: studio, flat, dark.
#pragma once

#include "engine/scene/film/film_look.hpp"
#include "render/picture/spheres/light/lamp.hpp"

namespace grainreel {

// colours_are_read: off a colour bar, so that light and shade may not stray far from them.
Lamp lamp_of(const FilmLook& look, bool colours_are_read);

}  // namespace grainreel
