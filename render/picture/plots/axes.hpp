// Round numbers for axes, and their words.
#pragma once

#include <cairo.h>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {

// Multiples of 1, 2 or 5 times a power of ten inside [low, high]: as many as there are, at most `most` (>=
// 2).
std::vector<double> round_ticks(double low, double high, int most);

// The ticks of an axis from `low` to `high`, and the distance that their decimals follow.
struct AxisTicks {
    std::vector<double> at;
    double distance = 1;
};
// At most `most` (>= 2) round ticks. Where only one of them lies inside, and one does not make an axis, the
// first and the last of up to `finest` round ticks.
AxisTicks axis_ticks(double low, double high, int most, int finest);

// Ticks of an axis that goes by ratios, low > 0: powers of ten, so many apart that there are at most `most`
// (>= 2); where less than two lie inside, 2 and 5 times them too.
std::vector<double> power_ticks(double low, double high, int most);

// The narrowest interval around [low, high] whose ends are such multiples, `most` of them at most. Equal ends
// are taken a little apart.
std::array<double, 2> round_limits(double low, double high, int most);

// As many decimals as the distance between ticks asks for, a minus as wide as a digit.
std::string tick_text(double value, double distance);

// What all plots draw alike: thin lines and titles.

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
