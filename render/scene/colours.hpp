// Colours by name, chosen to be told apart by everybody.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/film.hpp"

namespace grainreel {

// "#rrggbb" or a name of Okabe and Ito's palette (2008, jfly.uni-koeln.de/color), or black, white, grey.
std::optional<Colour> parse_colour(std::string_view text);

// The first of the palette's eight colours, from orange on, that is taken least often: not at all while one
// is free.
Colour default_colour(const std::vector<Colour>& taken);

// "#rrggbb".
std::string colour_text(const Colour& colour);

// The background of a film's pictures, where the scene names none.
Colour default_background(FilmLook::Style style);

}  // namespace grainreel
