// Formats of the film's file and what goes with each.
#pragma once

#include "engine/scene/keys/document.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

bool can_be_capped(FilmFormat format);

// Refuses what does not go with the film's format, and fits the rate to it. When size, rate and file are
// read.
void settle_film_file(const Document& document, FilmedScene& scene);

}  // namespace grainreel
