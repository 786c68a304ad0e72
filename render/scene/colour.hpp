// A colour, and the names by which scenes give it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

struct Colour {
    double red = 0, green = 0, blue = 0;  // sRGB, 0 to 1
    bool operator==(const Colour&) const = default;
};

// Reads "#rrggbb", black, white, grey, or a name of Okabe and Ito's palette (2008, jfly.uni-koeln.de/color),
// whose colours the colour-blind can tell apart too.
std::optional<Colour> parse_colour(std::string_view text);

// The palette's colour, from orange on, that is taken least often: a free one as long as there is one.
Colour default_colour(const std::vector<Colour>& taken);

// "#rrggbb".
std::string colour_text(const Colour& colour);

}  // namespace grainreel
