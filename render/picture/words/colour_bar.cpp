// The colour bars: what the colours of the grains and of the walls mean.
#include <algorithm>
#include <cmath>

#include "engine/scene/text/units.hpp"
#include "render/picture/base/colour_scale.hpp"
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

namespace {

struct BarTick {
    double share;  // of the bar, from its low end
    std::string words;
};

// Room for the words decides how many.
std::vector<BarTick> ticks_of(const ColourScale& scale, const TextStyle& style, double width) {
    const double low = scale.low() / scale.unit_size(), high = scale.high() / scale.unit_size();
    const auto most = [&](double nearest_low, double nearest_high) {
        const double widest = std::max(measure_text(tick_text(low, nearest_low), style).width,
                                       measure_text(tick_text(high, nearest_high), style).width);
        return std::clamp(static_cast<int>(width / (1.5 * widest)), 2, 6);
    };
    std::vector<BarTick> ticks;
    if (scale.logarithmic()) {
        for (const double value : power_ticks(low, high, most(low, high)))
            ticks.push_back({scale.share_of(value * scale.unit_size()), tick_text(value, value)});
        return ticks;
    }
    constexpr int finest = 9;
    const double apart = (high - low) / 3;
    const AxisTicks even = axis_ticks(low, high, most(apart, apart), finest);
    for (const double value : even.at)
        ticks.push_back({(value - low) / (high - low), tick_text(value, even.distance)});
    return ticks;
}

TextSize bar_block(const Writer& writer, const ColourScale& scale, double x, double y, double width) {
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
    double deepest = 0;
    for (const BarTick& one : ticks_of(scale, writer.minor(), width)) {
        const double at = bar.x + one.share * (bar.width - 1) + 0.5;
        const TextSize size = measure_text(one.words, writer.minor());
        const double left = std::clamp(at - 0.5 * size.width, x, std::max(x, x + width - size.width));
        if (writer.on) {
            const Colour& ink = writer.palette.ink;
            cairo_set_source_rgb(writer.on, ink.red, ink.green, ink.blue);
            cairo_move_to(writer.on, at, below);
            cairo_line_to(writer.on, at, below + tick);
            cairo_stroke(writer.on);
        }
        writer.write(left, below + 1.2 * tick, one.words, writer.minor(), writer.palette.faint_ink);
        deepest = std::max(deepest, size.height);
    }
    return {width, below + 1.2 * tick + deepest - y};
}

}  // namespace

std::vector<ColourScale> colour_scales(const Film& film) {
    std::vector<ColourScale> scales;
    if (!film.word_kinds.legend) return scales;
    if (film.shows.colour.by != GrainValue::species) scales.emplace_back(film.shows.colour);
    if (film.look.walls.coloured()) scales.emplace_back(film.look.walls);
    return scales;
}

TextSize colour_bar_block(const Writer& writer, const FilmedScene& scene, double x, double y, double width) {
    TextSize size;
    for (const ColourScale& scale : colour_scales(scene.film)) {
        if (size.height > 0) size.height += writer.type.gap;
        size.height += bar_block(writer, scale, x, y + size.height, width).height;
        size.width = width;
    }
    return size;
}

}  // namespace grainreel
