// The colour bar: what the grains' colours mean.
#include <algorithm>
#include <cmath>

#include "engine/scene/text/fitting_unit.hpp"
#include "render/picture/grains/colour_scale.hpp"
#include "render/picture/plots/ticks.hpp"
#include "render/picture/words/writer.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// Its ends have the colours of the range's ends, so that it can be read off a picture.
void paint_bar(cairo_t* on, const ColourScale& scale, int x, int y, int width, int height) {
    cairo_save(on);
    cairo_set_antialias(on, CAIRO_ANTIALIAS_NONE);
    for (int i = 0; i < width; ++i) {
        const double share = scale.bands() > 0 ? (i + 0.5) / width : i / (width - 1.0);
        const Colour colour = in_bytes(scale.at_share(share));
        cairo_set_source_rgb(on, colour.red, colour.green, colour.blue);
        cairo_rectangle(on, x + i, y, 1, height);
        cairo_fill(on);
    }
    cairo_restore(on);
}

// An arrow of the end's colour, beyond an end that stands for all values beyond it, too.
void paint_tip(cairo_t* on, const Colour& colour, const Colour& edge, double x, double tip, double y,
               int height) {
    const Colour own = in_bytes(colour);
    cairo_move_to(on, x, y);
    cairo_line_to(on, tip, y + 0.5 * height);
    cairo_line_to(on, x, y + height);
    cairo_close_path(on);
    cairo_set_source_rgb(on, own.red, own.green, own.blue);
    cairo_fill_preserve(on);
    cairo_set_source_rgb(on, edge.red, edge.green, edge.blue);  // light tips are lost on a light background
    cairo_set_line_width(on, std::max(1.0, 0.06 * height));
    cairo_stroke(on);
}

void paint_tips(const Writer& writer, const ColourScale& scale, const ColourBarPlace& bar) {
    const Colour& edge = writer.palette.faint_ink;
    if (bar.tip_below > 0)
        paint_tip(writer.on, scale.at_share(0), edge, bar.x, bar.x - bar.tip_below, bar.y, bar.height);
    if (bar.tip_above > 0)
        paint_tip(writer.on, scale.at_share(1), edge, bar.x + bar.width, bar.x + bar.width + bar.tip_above,
                  bar.y, bar.height);
}

}  // namespace

ColourBarPlace colour_bar_place(const ColourScale& scale, const TypeScale& type, double x, double y,
                                double width) {
    ColourBarPlace place;
    place.height = std::max(4, static_cast<int>(std::lround(0.7 * type.main)));
    const int tip = std::min(place.height, static_cast<int>(0.2 * width));
    place.tip_below = scale.open_below() ? tip : 0;
    place.tip_above = scale.open_above() ? tip : 0;
    place.x = static_cast<int>(std::ceil(x)) + place.tip_below;
    place.y = static_cast<int>(std::ceil(y));
    place.width = std::max(2, static_cast<int>(std::floor(width)) - place.tip_below - place.tip_above);
    return place;
}

TextSize colour_bar_block(const Writer& writer, const FilmedScene& scene, double x, double y, double width) {
    if (!has_colour_bar(scene.film)) return {};
    const ColourScale scale(scene.film.shows.colour);
    const TypeScale& type = writer.type;
    const TextSize title = writer.write(x, y, scale.title(), writer.minor(), writer.palette.ink, width, 3);
    const double top = y + title.height + 0.4 * type.gap;
    const ColourBarPlace bar = colour_bar_place(scale, type, x, top, width);
    const double tick = 0.3 * type.main, below = bar.y + bar.height;
    if (writer.on) {
        paint_bar(writer.on, scale, bar.x, bar.y, bar.width, bar.height);
        paint_tips(writer, scale, bar);
        const Colour& ink = writer.palette.ink;
        cairo_set_source_rgb(writer.on, ink.red, ink.green, ink.blue);
        cairo_set_line_width(writer.on, std::max(1.0, type.main / 16));
    }
    const double low = scale.low() / scale.unit_size(), high = scale.high() / scale.unit_size();
    // Room for the words decides how many.
    const double widest = std::max(measure_text(tick_text(low, (high - low) / 3), writer.minor()).width,
                                   measure_text(tick_text(high, (high - low) / 3), writer.minor()).width);
    const int most = std::clamp(static_cast<int>(width / (1.5 * widest)), 2, 6);
    constexpr int finest = 9;
    const AxisTicks ticks = axis_ticks(low, high, most, finest);
    double deepest = 0;
    for (const double value : ticks.at) {
        const double at = bar.x + (value - low) / (high - low) * (bar.width - 1) + 0.5;
        const std::string text = tick_text(value, ticks.distance);
        const TextSize size = measure_text(text, writer.minor());
        const double left = std::clamp(at - 0.5 * size.width, x, std::max(x, x + width - size.width));
        if (writer.on) {
            const Colour& ink = writer.palette.ink;
            cairo_set_source_rgb(writer.on, ink.red, ink.green, ink.blue);
            cairo_move_to(writer.on, at, below);
            cairo_line_to(writer.on, at, below + tick);
            cairo_stroke(writer.on);
        }
        writer.write(left, below + 1.2 * tick, text, writer.minor(), writer.palette.faint_ink);
        deepest = std::max(deepest, size.height);
    }
    return {width, below + 1.2 * tick + deepest - y};
}

}  // namespace grainreel
