// Axes of plots: round numbers for their ticks, the words of ticks, titles, and the upright axis that all
// plots have.
#pragma once

#include <cairo.h>
#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {

// The multiples of a step that lie inside [low, high]. The step is 1, 2 or 5 times a power of ten: the finest
// one that gives at most `most` (>= 2) multiples.
std::vector<double> round_ticks(double low, double high, int most);

// The ticks of an axis, and the distance that decides how many decimals they have.
struct AxisTicks {
    std::vector<double> at;
    double distance = 1;
};
// At most `most` (>= 2) round ticks from `low` to `high`. One tick does not make an axis. Where only one lies
// inside, the axis has the first and the last of up to `finest` round ticks.
AxisTicks axis_ticks(double low, double high, int most, int finest);

// Ticks of a logarithmic axis, low > 0: at most `most` (>= 2) powers of ten. Where fewer than two lie inside,
// there are also ticks at 2 and 5 times the powers.
std::vector<double> power_ticks(double low, double high, int most);

// The narrowest interval around [low, high] whose ends are ticks and which has at most `most` ticks. If low
// equals high, they are first moved a little apart.
std::array<double, 2> round_limits(double low, double high, int most);

// The words of a tick. They have as many decimals as the distance between ticks needs, and a minus as wide as
// a digit.
std::string tick_text(double value, double distance);

inline double line_height(double letters) {
    return measure_text("0", {letters, false}).height;
}

// How many lines the title above the box may have. It may have two where these leave enough of the plot's
// height to the box.
inline int title_lines(int plot_height, const TypeScale& type) {
    return plot_height > 9 * type.main ? 2 : 1;
}

// Draws the title. A title on one line shrinks its letters somewhat before it is cut short.
inline void draw_title(cairo_t* on, const std::string& title, int width, int height, const TypeScale& type,
                       const Colour& colour) {
    constexpr double least_shrink = 0.75;
    const int lines = title_lines(height, type);
    TextStyle style{type.main, false};
    if (lines == 1)
        style.size *= std::clamp(0.99 * width / measure_text(title, style).width, least_shrink, 1.0);
    draw_text(on, 0, 0, title, style, colour, width, lines);
}

// The box that curves are drawn in; pixels from the plot's corner.
struct PlotBox {
    double left = 0, right = 1, top = 0, bottom = 1;
};

constexpr int most_axis_ticks = 4;

// Ticks of the upright axis: as many as fit above each other.
AxisTicks upright_ticks(const PlotBox& box, const TypeScale& type, double low, double high);

// Draws the upright axis: a faint line across the box at each tick, the words of the tick beside it, and the
// axis. height_of: height of a tick, pixels from the plot's corner.
void draw_upright_axis(cairo_t* on, const PlotBox& box, const AxisTicks& ticks,
                       const std::function<double(double tick)>& height_of, const TypeScale& type,
                       const Palette& palette);

}  // namespace grainreel
