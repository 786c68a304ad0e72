// The blocks of words that tell what colours mean (blocks.hpp): the legend of species, and the colour bars of
// grains and walls.
#include "render/picture/words/blocks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/text/units.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/plots/axes.hpp"
#include "render/picture/spheres/light/lamp.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// The formula of light_as() in light-inl.hpp, for a ball that is seen straight on and has nothing around it.
// Change both together, or the legend has other colours than the grains.
Colour lit(const Vec3& normal, const Colour& albedo) {
    const Lamp lamp;
    const Vec3 key(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]), eye(0, 0, -1);
    const double falls = std::max(0.0, normal.dot(key));
    const double ambient = lamp.ground + (lamp.sky - lamp.ground) * (0.5 + 0.5 * normal.y());
    const double t = std::clamp(normal.dot(eye) / lamp.rim_width, 0.0, 1.0);
    const double rim = lamp.rim + (1 - lamp.rim) * t * t * (3 - 2 * t);
    const double gloss = std::max(0.0, normal.dot((key + eye).normalized()));
    const double shine = lamp.shine * std::pow(gloss, 32) * std::min(4 * falls, 1.0);
    const auto channel = [&](double srgb) {
        return to_srgb(std::clamp(to_linear(srgb) * (ambient + lamp.key * falls) * rim + shine, 0.0, 1.0));
    };
    return {channel(albedo.red), channel(albedo.green), channel(albedo.blue)};
}

// Draws a small sphere of the legend, lit as the grains are: a picture of the lit hemisphere, cut out by a
// smooth circle. (x, y): centre, pixels. colour(share): the sphere's own colour at a height, 0 to 1.
template <class ColourAt>
void draw_lit_ball(cairo_t* on, double x, double y, double radius, const ColourAt& colour) {
    const int side = 2 * static_cast<int>(std::ceil(radius)) + 2;
    const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, side);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(stride) * side);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            double u = (column + 0.5 - 0.5 * side) / radius, v = (0.5 * side - row - 0.5) / radius;
            const double length = std::hypot(u, v);
            if (length > 1) {
                u /= length;
                v /= length;
            }
            const Vec3 normal(u, v, -std::sqrt(std::max(0.0, 1 - u * u - v * v)));
            const Colour shade = lit(normal, colour(0.5 + 0.5 * v));
            const std::array<double, 3> channels = {shade.blue, shade.green, shade.red};
            for (std::size_t c = 0; c < 3; ++c)
                pixels[static_cast<std::size_t>(row) * stride + 4 * static_cast<std::size_t>(column) + c] =
                    static_cast<std::uint8_t>(std::lround(255 * channels[c]));
        }
    cairo_surface_t* ball =
        cairo_image_surface_create_for_data(pixels.data(), CAIRO_FORMAT_RGB24, side, side, stride);
    cairo_set_source_surface(on, ball, x - 0.5 * side, y - 0.5 * side);
    cairo_new_path(on);
    cairo_arc(on, x, y, radius, 0, 2 * M_PI);
    cairo_fill(on);
    cairo_set_source_rgb(on, 0, 0, 0);  // releases the surface
    cairo_surface_destroy(ball);
}

constexpr std::size_t most_species = 12;  // a last line sums up all others

// The entries of a legend: the first `shown` species have one each, and the others have one together.
class Entries {
  public:
    Entries(const Writer& writer, const FilmedScene& scene, double wrap)
        : writer_(writer), scene_(scene), wrap_(wrap), icon_(1.5 * writer.type.main) {}

    std::size_t count(std::size_t shown) const { return shown + (shown < scene_.species.size() ? 1 : 0); }

    // Draws the entries in as many columns as there is room for.
    TextSize draw(std::size_t shown, double x, double y) const {
        const double gap = writer_.type.gap;
        double widest = 1;
        for (std::size_t i = 0; i < count(shown); ++i)
            widest = std::max(widest, measured().entry(i, shown, 0, 0, 0).width);
        const auto columns =
            static_cast<std::size_t>(std::max(1.0, std::floor((wrap_ + gap) / (widest + gap))));
        TextSize size;
        for (std::size_t first = 0; first < count(shown); first += columns) {
            double height = 0;
            for (std::size_t i = first; i < std::min(count(shown), first + columns); ++i) {
                const double left = static_cast<double>(i - first) * (widest + gap);
                const TextSize one = entry(i, shown, x + left, y + size.height, columns > 1 ? 0 : wrap_);
                size.width = std::max(size.width, left + one.width);
                height = std::max(height, one.height);
            }
            size.height += height + 0.4 * gap;
        }
        return size;
    }

    Entries measured() const { return {{nullptr, writer_.type, writer_.palette}, scene_, wrap_}; }

  private:
    // The lines that say how many grains a species has. Where the number changes, they say how many there are
    // at the start, and how many are fed in the course of the run. A species may be there for the walls
    // alone.
    std::vector<std::string> numbers_of(const Species& species) const {
        const std::string wide = diameter_text(species.diameter);
        const Wording& say = scene_.film.wording;
        if (species.all() == 0) return {say(Word::glued, {wide})};
        if (species.count == 0) return {say(Word::fed, {fmt::format("{} × {}", species.fed, wide)})};
        const Container& container = scene_.container;
        const bool changes = species.fed > 0 || (container.outlet && !container.tray);
        const std::string number = fmt::format("{} × {}", species.count, wide);
        std::vector<std::string> lines{changes ? say(Word::at_the_start, {number}) : number};
        if (species.fed > 0) lines.push_back(say(Word::more_fed, {std::to_string(species.fed)}));
        return lines;
    }

    // A ball of the species' colour and relative size, its name, and how many there are.
    TextSize entry(std::size_t i, std::size_t shown, double x, double y, double wrap) const {
        const double indent = icon_ + 0.5 * writer_.type.gap;
        const double text_wrap = wrap > 0 ? std::max(1.0, wrap - indent) : 0;
        TextSize size;
        const auto line = [&](const std::string& text, const TextStyle& style, const Colour& colour) {
            constexpr int most_lines = 2;
            const TextSize part =
                writer_.write(x + indent, y + size.height, text, style, colour, text_wrap, most_lines);
            size.width = std::max(size.width, indent + part.width);
            size.height += part.height;
        };
        if (i == shown) {
            line(scene_.film.wording(Word::more_species, {std::to_string(scene_.species.size() - i)}),
                 writer_.minor(), writer_.palette.faint_ink);
            return size;
        }
        const Species& species = scene_.species[i];
        line(species.name, writer_.main(), writer_.palette.ink);
        for (const std::string& numbers : numbers_of(species))
            line(numbers, writer_.minor(), writer_.palette.faint_ink);
        const double share =
            std::max(0.25, species.diameter.largest / std::max(largest_diameter(scene_), 1e-30));
        if (writer_.on) draw_ball(i, x + 0.5 * icon_, y + 0.5 * size.height, 0.5 * icon_ * share);
        return size;
    }

    // A species whose colours stand for a quantity has all colours of the bar, so that it does not look like
    // one that only walls have.
    void draw_ball(std::size_t i, double x, double y, double radius) const {
        const GrainColouring& colouring = scene_.film.shows.colour;
        if (colouring.colours(i) && scene_.species[i].all() > 0) {
            const ColourScale scale(colouring);
            return draw_lit_ball(writer_.on, x, y, radius,
                                 [&](double share) { return scale.at_share(share); });
        }
        const bool plain =
            colouring.by == GrainValue::species || (colouring.of_grains() && !colouring.colours(i));
        const Colour own = plain ? scene_.colours[i] : neutral_grain;
        draw_lit_ball(writer_.on, x, y, radius, [&](double) { return own; });
    }

    const Writer writer_;
    const FilmedScene& scene_;
    const double wrap_, icon_;
};

}  // namespace

std::size_t species_in_legend(const Writer& writer, const FilmedScene& scene, double wrap, double room) {
    const Entries entries = Entries(writer, scene, wrap).measured();
    std::size_t shown = std::min(scene.species.size(), most_species);
    while (shown > 0 && room > 0 && entries.draw(shown, 0, 0).height > room) --shown;
    return shown;
}

TextSize legend_block(const Writer& writer, const FilmedScene& scene, double x, double y, double wrap,
                      double room) {
    if (!scene.film.word_kinds.legend) return {};
    const std::size_t shown = species_in_legend(writer, scene, wrap, room);
    return shown > 0 ? Entries(writer, scene, wrap).draw(shown, x, y) : TextSize{};
}

namespace {

// The bar's ends have the colours of the range's ends, so that values can be read off a picture.
void paint_bar(cairo_t* on, const ColourScale& scale, int x, int y, int width, int height) {
    cairo_save(on);
    cairo_set_antialias(on, CAIRO_ANTIALIAS_NONE);
    for (int i = 0; i < width; ++i) {
        const double share = scale.bands() > 0 ? (i + 0.5) / width : i / (width - 1.0);
        const Colour colour = in_bytes(scale.at_share(share));
        set_colour(on, colour);
        cairo_rectangle(on, x + i, y, width - i, height);  // to the end, so that no seam shows in a PDF
        cairo_fill(on);
    }
    cairo_restore(on);
}

// Paints an arrow of the end's colour beyond an end that also stands for all values beyond it.
void paint_tip(cairo_t* on, const Colour& colour, const Colour& edge, double x, double tip, double y,
               int height) {
    const Colour own = in_bytes(colour);
    cairo_move_to(on, x, y);
    cairo_line_to(on, tip, y + 0.5 * height);
    cairo_line_to(on, x, y + height);
    cairo_close_path(on);
    set_colour(on, own);
    cairo_fill_preserve(on);
    set_colour(on, edge);  // the edge shows light tips on a light background
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

struct BarTick {
    double share;  // share of the bar, from its low end
    std::string words;
};

// The room for their words decides how many ticks there are.
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
        set_colour(writer.on, writer.palette.ink);
        cairo_set_line_width(writer.on, std::max(1.0, type.main / 16));
    }
    double deepest = 0;
    for (const BarTick& one : ticks_of(scale, writer.minor(), width)) {
        const double at = bar.x + one.share * (bar.width - 1) + 0.5;
        const TextSize size = measure_text(one.words, writer.minor());
        const double left = std::clamp(at - 0.5 * size.width, x, std::max(x, x + width - size.width));
        if (writer.on) {
            set_colour(writer.on, writer.palette.ink);
            draw_line(writer.on, at, below, at, below + tick);
        }
        writer.write(left, below + 1.2 * tick, one.words, writer.minor(), writer.palette.faint_ink);
        deepest = std::max(deepest, size.height);
    }
    return {width, below + 1.2 * tick + deepest - y};
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

std::vector<ColourScale> colour_scales(const Film& film) {
    std::vector<ColourScale> scales;
    if (!film.word_kinds.legend) return scales;
    if (film.shows.colour.by != GrainValue::species) scales.emplace_back(film.shows.colour, film.wording);
    if (film.look.walls.coloured()) scales.emplace_back(film.look.walls, film.wording);
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
