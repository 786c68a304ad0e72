// Colours by name, chosen to be told apart by everybody.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/scene/scene.hpp"

namespace grainreel {

// "#rrggbb" or a name of Okabe and Ito's palette (2008, jfly.uni-koeln.de/color), or black, white, grey.
std::optional<Colour> parse_colour(std::string_view text);

// The palette's n-th colour, from orange on; starts again after the eighth.
Colour default_colour(std::size_t n);

// "#rrggbb".
std::string colour_text(const Colour& colour);

}  // namespace grainreel
