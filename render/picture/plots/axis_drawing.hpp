// What all plots draw alike: thin lines and titles.
#pragma once

#include <cairo.h>

#include <algorithm>
#include <string>

#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {

inline void set_colour(cairo_t* on, const Colour& colour, double alpha = 1) {
    cairo_set_source_rgba(on, colour.red, colour.green, colour.blue, alpha);
}

inline void draw_line(cairo_t* on, double x0, double y0, double x1, double y1) {
    cairo_move_to(on, x0, y0);
    cairo_line_to(on, x1, y1);
    cairo_stroke(on);
}

inline double line_height(double letters) {
    return measure_text("0", {letters, false}).height;
}

// Lines of the words above the box: two where enough of the plot's height is left to it.
inline int title_lines(int plot_height, const TypeScale& type) {
    return plot_height > 9 * type.main ? 2 : 1;
}

// Letters of a title on one line shrink somewhat before it is cut short.
inline void draw_title(cairo_t* on, const std::string& title, int width, int height, const TypeScale& type,
                       const Colour& colour) {
    constexpr double least_shrink = 0.75;
    const int lines = title_lines(height, type);
    TextStyle style{type.main, false};
    if (lines == 1)
        style.size *= std::clamp(0.99 * width / measure_text(title, style).width, least_shrink, 1.0);
    draw_text(on, 0, 0, title, style, colour, width, lines);
}

}  // namespace grainreel
