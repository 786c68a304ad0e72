// What the marks over the grains mean.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/film/grain_values.hpp"
#include "render/draw/marks/marks.hpp"
#include "render/draw/words/captions.hpp"
#include "render/draw/words/writer.hpp"

namespace grainreel {
namespace {

// With a space that no line breaks at.
std::string quantity_text(double value, Dimension dimension) {
    const std::string unit = fitting_unit(value * 1.0000001, dimension);
    return fmt::format("{:.3g}\u00a0{}", value / unit_size(unit, dimension), unit);
}

}  // namespace

TextSize marks_block(const Writer& writer, const Scene& scene, double scale, double x, double y,
                     double wrap) {
    const FilmShows& look = scene.film.shows;
    const TypeScale& type = writer.type;
    const double pen = std::max(1.0, type.main / 14), icon = 2.2 * type.main, gap = 0.6 * type.gap;
    TextSize size{wrap, 0};
    // A sample of the mark, as wide as `reach`, and its words beside or below it.
    const auto entry = [&](double reach, const std::string& words, const auto& sample) {
        const double indent = std::max(reach, icon) + gap;
        const double text_wrap = std::max(1.0, wrap - indent);
        const TextSize text = measure_text(words, writer.minor(), text_wrap, 5);
        const double row = std::max(text.height, 1.3 * type.main);
        if (writer.on) {
            cairo_new_path(writer.on);
            sample(y + size.height + 0.5 * row);
        }
        writer.write(x + indent, y + size.height + 0.5 * (row - text.height), words, writer.minor(),
                     writer.palette.ink, text_wrap, 5);
        size.height += row + gap;
    };
    const auto colour = [&](const Colour& c) { cairo_set_source_rgb(writer.on, c.red, c.green, c.blue); };
    const auto line = [&](double reach, double width, double middle) {
        cairo_set_line_width(writer.on, width);
        cairo_move_to(writer.on, x, middle);
        cairo_line_to(writer.on, x + reach, middle);
        cairo_stroke(writer.on);
    };
    if (look.arrows.across > 0) {
        const double metre = arrow_scale(scene) * scale;  // pixels for each m/s
        const double most = 0.28 * wrap;
        const double speed = round_length(std::max(1e-9, most / metre)), reach = speed * metre;
        const std::string when = look.arrows.period ? "mean velocity over a period" : "mean velocity";
        entry(most, fmt::format("{}, {}", quantity_text(speed, Dimension::speed), when), [&](double middle) {
            colour(writer.palette.ink);
            const double head = std::min(3.5 * pen, 0.5 * reach);
            line(reach - head, pen, middle);
            cairo_move_to(writer.on, x + reach, middle);
            cairo_line_to(writer.on, x + reach - head, middle - 0.45 * head);
            cairo_line_to(writer.on, x + reach - head, middle + 0.45 * head);
            cairo_close_path(writer.on);
            cairo_fill(writer.on);
        });
    }
    if (look.trails.wanted())
        entry(icon, fmt::format("paths of the last {}", quantity_text(look.trails.duration, Dimension::time)),
              [&](double middle) {
                  colour(writer.palette.accent);
                  line(icon, 1.5 * pen, middle);
              });
    if (look.force_chains)
        entry(icon,
              fmt::format("contact force, {} or more", quantity_text(widest_force(scene), Dimension::force)),
              [&](double middle) {
                  colour(writer.palette.force);
                  line(icon, widest_line(scene.film.height), middle);
              });
    std::string ringed;
    if (!look.highlighted.empty())
        ringed = fmt::format("{} {}", look.highlighted.size() > 1 ? "grains" : "grain",
                             fmt::join(look.highlighted, ", "));
    if (look.highlight_if.wanted()) ringed += (ringed.empty() ? "" : ", ") + look.highlight_if.text;
    if (!ringed.empty())
        entry(icon, ringed, [&](double middle) {
            colour(writer.palette.accent);
            cairo_set_line_width(writer.on, 1.4 * pen);
            cairo_arc(writer.on, x + 0.5 * icon, middle, 0.5 * type.main, 0, 2 * std::numbers::pi);
            cairo_stroke(writer.on);
        });
    if (size.height > 0) size.height -= gap;
    return size;
}

}  // namespace grainreel
