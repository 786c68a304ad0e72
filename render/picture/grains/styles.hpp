// The three lights: studio, flat, dark.
#pragma once

#include "render/picture/spheres/light/lamp.hpp"
#include "render/scene/film_look.hpp"

namespace grainreel {

// colours_are_read: off a colour bar, so that light and shade may not stray far from them.
Lamp lamp_of(const FilmLook& look, bool colours_are_read);

}  // namespace grainreel
