// What the marks over the grains mean.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/text/units.hpp"
#include "render/picture/marks/marks.hpp"
#include "render/picture/words/captions.hpp"
#include "render/picture/words/writer.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

// With a space that no line breaks at.
std::string quantity_text(double value, Dimension dimension) {
    const std::string unit = fitting_unit(value * 1.0000001, dimension);
    return fmt::format("{:.3g}\u00a0{}", value / unit_size(unit, dimension), unit);
}

// Entries below each other: a sample of a mark, and its words beside it.
class MarksLegend {
  public:
    MarksLegend(const Writer& writer, double x, double y, double wrap)
        : writer_(writer),
          pen_(std::max(1.0, writer.type.main / 14)),
          icon_(2.2 * writer.type.main),
          gap_(0.6 * writer.type.gap),
          x_(x),
          y_(y),
          wrap_(wrap) {}

    double pen() const { return pen_; }
    double height() const { return height_ > 0 ? height_ - gap_ : 0; }

    // A straight line of that width.
    void line(const Colour& colour, double width, const std::string& words) {
        entry(icon_, words, [&](double middle) { draw_line(colour, icon_, width, middle); });
    }
    void ring(const Colour& colour, const std::string& words) {
        entry(icon_, words, [&](double middle) {
            cairo_set_source_rgb(writer_.on, colour.red, colour.green, colour.blue);
            cairo_set_line_width(writer_.on, 1.4 * pen_);
            cairo_arc(writer_.on, x_ + 0.5 * icon_, middle, 0.5 * writer_.type.main, 0, 2 * std::numbers::pi);
            cairo_stroke(writer_.on);
        });
    }
    // An arrow of a round value, whose unit is so many pixels long.
    void arrow(double pixels, Dimension dimension, const Colour& colour, double width,
               const std::string& words) {
        const double most = 0.28 * wrap_;
        const double value = round_length(std::max(1e-12, most / pixels)), reach = value * pixels;
        entry(most, fmt::format("{}, {}", quantity_text(value, dimension), words), [&](double middle) {
            const double head = std::min(3.5 * width, 0.5 * reach);
            draw_line(colour, reach - head, width, middle);
            cairo_move_to(writer_.on, x_ + reach, middle);
            cairo_line_to(writer_.on, x_ + reach - head, middle - 0.45 * head);
            cairo_line_to(writer_.on, x_ + reach - head, middle + 0.45 * head);
            cairo_close_path(writer_.on);
            cairo_fill(writer_.on);
        });
    }

  private:
    // sample(middle) draws, as wide as `reach`.
    template <class Sample>
    void entry(double reach, const std::string& words, const Sample& sample) {
        const double indent = std::max(reach, icon_) + gap_, text_wrap = std::max(1.0, wrap_ - indent);
        const TextSize text = measure_text(words, writer_.minor(), text_wrap, 5);
        const double row = std::max(text.height, 1.3 * writer_.type.main), top = y_ + height_;
        if (writer_.on) {
            cairo_new_path(writer_.on);
            sample(top + 0.5 * row);
        }
        writer_.write(x_ + indent, top + 0.5 * (row - text.height), words, writer_.minor(),
                      writer_.palette.ink, text_wrap, 5);
        height_ += row + gap_;
    }
    void draw_line(const Colour& colour, double reach, double width, double middle) const {
        cairo_set_source_rgb(writer_.on, colour.red, colour.green, colour.blue);
        cairo_set_line_width(writer_.on, width);
        cairo_move_to(writer_.on, x_, middle);
        cairo_line_to(writer_.on, x_ + reach, middle);
        cairo_stroke(writer_.on);
    }

    const Writer& writer_;
    const double pen_, icon_, gap_, x_, y_, wrap_;  // pixels
    double height_ = 0;
};

constexpr std::size_t most_named = 12;  // grains

std::string words_of_rings(const FilmShows& look) {
    std::string ringed;
    if (!look.highlighted.empty())
        ringed = look.highlighted.size() > most_named
                     ? fmt::format("{} grains", look.highlighted.size())
                     : fmt::format("{} {}", look.highlighted.size() > 1 ? "grains" : "grain",
                                   fmt::join(look.highlighted, ", "));
    if (look.highlight_if.wanted()) ringed += (ringed.empty() ? "" : ", ") + look.highlight_if.text;
    return ringed;
}

}  // namespace

TextSize marks_block(const Writer& writer, const FilmedScene& scene, double scale, double x, double y,
                     double wrap) {
    const FilmShows& look = scene.film.shows;
    if (!scene.film.word_kinds.legend) return {};
    const Palette& palette = writer.palette;
    MarksLegend legend(writer, x, y, wrap);
    if (look.arrows.across > 0)
        legend.arrow(arrow_scale(scene) * scale, Dimension::speed, palette.ink, legend.pen(),
                     look.arrows.period ? "mean velocity over a period" : "mean velocity");
    if (look.streamlines.across > 0)
        legend.line(palette.ink, widest_streamline(scene.film.height),
                    fmt::format("streamlines{}, this wide from {} on",
                                look.streamlines.period ? " over a period" : "",
                                quantity_text(look.streamlines.speed, Dimension::speed)));
    if (look.wall_forces.wanted)
        legend.arrow(wall_force_scale(scene) * scale, Dimension::force, palette.wall_force,
                     1.7 * legend.pen(), "mean force on a wall");
    if (look.trails.wanted())
        legend.line(
            palette.accent, 1.5 * legend.pen(),
            fmt::format("paths of the last {}", quantity_text(look.trails.duration, Dimension::time)));
    if (look.force_chains)
        legend.line(
            palette.force, widest_line(scene.film.height),
            fmt::format("contact force, {} or more", quantity_text(widest_force(scene), Dimension::force)));
    if (const std::string ringed = words_of_rings(look); !ringed.empty()) legend.ring(palette.accent, ringed);
    return {wrap, legend.height()};
}

}  // namespace grainreel
