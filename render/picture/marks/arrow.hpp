// An arrow over the grains, on a border of the background's colour so that it reads on any grain.
#pragma once

#include <algorithm>

#include "render/picture/base/canvas.hpp"

namespace grainreel {

struct ArrowStyle {
    Colour colour, border;
    double width;  // pixels, of its shaft
    double pen;    // pixels, of the border
};

inline void draw_arrow(Shapes& on, const Pixel& tail, const Pixel& tip, const ArrowStyle& style) {
    const double length = (tip - tail).norm();
    if (length < 1) return;
    const Pixel ahead = (tip - tail) / length, aside(-ahead.y(), ahead.x());
    const double head = std::min(3.6 * style.width, 0.5 * length);
    const Pixel neck = tip - head * ahead;
    const std::vector<Pixel> corners{tip, neck + 0.45 * head * aside, neck - 0.45 * head * aside};
    on.line(corners, true, 2 * style.pen, {style.border, 1});
    on.line({tail, neck}, false, style.width + 2 * style.pen, {style.border, 1});
    on.line({tail, neck}, false, style.width, {style.colour, 1});
    on.polygon(corners, {style.colour, 1});
    on.line(corners, true, 0.5 * style.pen, {style.colour, 1});
}

}  // namespace grainreel
