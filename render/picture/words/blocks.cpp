// Blocks of words around a picture: title, scale bar, arrows, axes, drive, clock and notes.
#include "render/picture/words/blocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/picture/container/drawing_kit.hpp"
#include "render/picture/words/captions.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

void stroke_line(const Writer& writer, double x0, double y0, double x1, double y1, double width) {
    cairo_set_line_width(writer.on, width);
    draw_line(writer.on, x0, y0, x1, y1);
}

void dot(const Writer& writer, double x, double y, double radius) {
    cairo_new_path(writer.on);
    cairo_arc(writer.on, x, y, radius, 0, 2 * std::numbers::pi);
    cairo_fill(writer.on);
}

// Draws an arrow about (x, y) with half its length along (dx, dy); pixels. It has a head at the far end, or
// at both ends.
void arrow(const Writer& writer, double x, double y, double dx, double dy, bool both) {
    const double length = std::hypot(dx, dy), width = std::max(1.0, writer.type.main / 12);
    const double head = 3.2 * width;
    stroke_line(writer, x - dx, y - dy, x + dx, y + dy, width);
    if (length < 1) return;
    for (const double end : {1.0, -1.0}) {
        if (end < 0 && !both) break;
        const double ux = end * dx / length, uy = end * dy / length;
        const double tip_x = x + end * dx + ux * head * 0.4, tip_y = y + end * dy + uy * head * 0.4;
        cairo_move_to(writer.on, tip_x, tip_y);
        cairo_line_to(writer.on, tip_x - 1.5 * head * ux - 0.6 * head * uy,
                      tip_y - 1.5 * head * uy + 0.6 * head * ux);
        cairo_line_to(writer.on, tip_x - 1.5 * head * ux + 0.6 * head * uy,
                      tip_y - 1.5 * head * uy - 0.6 * head * ux);
        cairo_close_path(writer.on);
        cairo_fill(writer.on);
    }
}

// Draws a sample of the scale that draw_lab_marks() draws beside the floor.
void lab_mark_sample(const Writer& writer, double x, double y, double reach) {
    const double pen = std::max(1.0, writer.type.main / 16), bar = x, low = 0.8 * reach;
    set_colour(writer.on, writer.palette.faint_ink);
    stroke_line(writer, bar, y - low, bar, y + low, pen);
    for (const double level : {-1.0, 0.0, 1.0})
        stroke_line(writer, bar - (level == 0 ? 0.9 : 0.5) * reach, y + level * low, bar, y + level * low,
                    pen);
    set_colour(writer.on, writer.palette.accent);
    cairo_move_to(writer.on, bar, y);
    cairo_line_to(writer.on, bar + 0.85 * reach, y - 0.4 * reach);
    cairo_line_to(writer.on, bar + 0.85 * reach, y + 0.4 * reach);
    cairo_close_path(writer.on);
    cairo_fill(writer.on);
}

// Draws an arrow along the line of sight: a ring with the arrow's tip in it, or with its feathers.
void arrow_on_end(const Writer& writer, double x, double y, bool towards_eye) {
    const double radius = 0.42 * writer.type.main, width = std::max(1.0, writer.type.main / 12);
    cairo_new_path(writer.on);
    cairo_arc(writer.on, x, y, radius, 0, 2 * std::numbers::pi);
    cairo_set_line_width(writer.on, width);
    cairo_stroke(writer.on);
    if (towards_eye) return dot(writer, x, y, 0.3 * radius);
    const double reach = radius / std::numbers::sqrt2;
    stroke_line(writer, x - reach, y - reach, x + reach, y + reach, width);
    stroke_line(writer, x - reach, y + reach, x + reach, y - reach, width);
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find('\n', from), text.size());
        lines.push_back(text.substr(from, to - from));
        from = to + 1;
    }
    return lines;
}

TextSize title_block(const Writer& writer, const FilmedScene& scene, double x, double y, double wrap) {
    const std::string title = shown_title(scene.film);
    if (title.empty()) return {};
    return writer.write(x, y, title, writer.title(), writer.palette.ink, wrap, 6);
}

TextSize scale_block(const Writer& writer, double scale, double x, double y, double longest) {
    const double length = round_length(longest / scale), pixels = length * scale;
    const double tick = 0.35 * writer.type.main, width = std::max(1.5, writer.type.main / 11);
    if (writer.on) {
        set_colour(writer.on, writer.palette.ink);
        stroke_line(writer, x, y + 0.5 * tick, x + pixels, y + 0.5 * tick, width);
        for (const double end : {x + 0.5 * width, x + pixels - 0.5 * width})
            stroke_line(writer, end, y, end, y + tick, width);
    }
    const TextSize label =
        writer.write(x, y + 1.3 * tick, length_text(length), writer.main(), writer.palette.ink);
    return {std::max(pixels, label.width), 1.3 * tick + label.height};
}

namespace {

// Draws an arrow of half the length `reach` about (x, y) as the camera sees the direction. view: null: seen
// along -x.
void draw_direction(const Writer& writer, const Vec3& along, const View* view, double x, double y,
                    double reach, bool both) {
    const double across = view ? along.dot(view->right) : along.y(),
                 up = view ? along.dot(view->up) : along.z();
    const double away = view ? along.dot(view->forward) : -along.x();
    set_colour(writer.on, both ? writer.palette.accent : writer.palette.ink);
    if (std::hypot(across, up) < 0.2)
        arrow_on_end(writer, x, y, both || away < 0);
    else
        arrow(writer, x, y, reach * across, -reach * up, both);
}

Word word_of_shaking(const Drive& drive) {
    return drive.moves == Drive::Moves::floor ? Word::floor_vibrates : Word::vibration;
}

}  // namespace

TextSize shaking_block(const Writer& writer, const FilmedScene& scene, const std::string& numbers,
                       const View* view, double x, double y) {
    const double reach = 0.75 * writer.type.main, indent = 1.5 * writer.type.main + 0.4 * writer.type.gap;
    TextSize words;
    writer.write_below(words, x + indent, y, scene.film.wording(word_of_shaking(scene.drive)), writer.main(),
                       writer.palette.ink);
    if (!numbers.empty())
        writer.write_below(words, x + indent, y, numbers, writer.minor(), writer.palette.ink);
    const TextSize size{indent + words.width, std::max(words.height, 2.2 * writer.type.main)};
    if (writer.on)
        draw_direction(writer, scene.drive.direction, view, x + 0.75 * writer.type.main,
                       y + 0.5 * size.height, reach, true);
    return size;
}

TextSize arrows_block(const Writer& writer, const FilmedScene& scene, const View* view, double x, double y) {
    const double reach = 0.75 * writer.type.main, row = 2.2 * writer.type.main,
                 indent = 1.5 * writer.type.main;
    TextSize size;
    if (!scene.film.word_kinds.arrows) return size;
    // sample(x, y) draws a sample about this point.
    const auto entry = [&](const std::string& label, const auto& sample) {
        const double middle = y + size.height + 0.5 * row;
        if (writer.on) sample(x + 0.5 * indent, middle);
        const double half_line = 0.5 * measure_text(label, writer.minor()).height;
        const TextSize text = writer.write(x + indent + 0.4 * writer.type.gap, middle - half_line, label,
                                           writer.minor(), writer.palette.faint_ink);
        size.width = std::max(size.width, indent + 0.4 * writer.type.gap + text.width);
        size.height += row;
    };
    const auto direction = [&](const Vec3& along, bool both) {
        return [&, along, both](double at_x, double at_y) {
            draw_direction(writer, along, view, at_x, at_y, reach, both);
        };
    };
    const Wording& say = scene.film.wording;
    if (scene.gravity.norm() > 0) entry(say(Word::gravity), direction(scene.gravity.normalized(), false));
    if (!scene.drive.present) return size;
    if (!scene.film.word_kinds.shaking)
        entry(say(word_of_shaking(scene.drive)), direction(scene.drive.direction, true));
    if (has_lab_marks(scene))
        entry(say(Word::floor),
              [&](double at_x, double at_y) { lab_mark_sample(writer, at_x, at_y, reach); });
    return size;
}

TextSize axes_block(const Writer& writer, const FilmedScene& scene, const View* view, double x, double y) {
    if (!scene.film.axes) return {};
    const double reach = 1.6 * writer.type.main, side = 2 * reach + 2 * writer.type.minor;
    if (!writer.on || !view) return {side, side + writer.type.gap};
    const double cx = x + 0.5 * side, cy = y + 0.5 * side, pen = std::max(1.0, writer.type.main / 12);
    std::vector<std::pair<Vec3, const char*>> axes = {
        {Vec3::UnitX(), "x"}, {Vec3::UnitY(), "y"}, {Vec3::UnitZ(), "z"}};
    // The farthest axis is drawn first, so that the nearest one is whole.
    std::sort(axes.begin(), axes.end(), [&](const auto& a, const auto& b) {
        return a.first.dot(view->forward) > b.first.dot(view->forward);
    });
    for (const auto& [axis, name] : axes) {
        const double dx = axis.dot(view->right), dy = -axis.dot(view->up);
        set_colour(writer.on,
                   mix(writer.palette.ink, writer.palette.background, 0.25 * (1 + axis.dot(view->forward))));
        stroke_line(writer, cx, cy, cx + reach * dx, cy + reach * dy, 1.6 * pen);
        dot(writer, cx + reach * dx, cy + reach * dy, 2 * pen);
        // The letter stands beyond the tip, also where the axis points at the eye.
        const double seen = std::max(std::hypot(dx, dy), 1e-9), away = reach * seen + 0.8 * writer.type.minor;
        const TextSize letter = measure_text(name, writer.minor());
        writer.write(cx + away * dx / seen - 0.5 * letter.width, cy + away * dy / seen - 0.5 * letter.height,
                     name, writer.minor(), writer.palette.ink);
    }
    return {side, side + writer.type.gap};
}

TextSize drive_block(const Writer& writer, const FilmedScene& scene, const State* frame, const View* view,
                     double x, double y) {
    if (!scene.drive.present) return {};
    TextSize size;
    std::vector<std::string> lines;
    const WordKinds& kinds = scene.film.word_kinds;
    if (kinds.shaking) {
        const std::string numbers = kinds.drive ? ""
                                    : frame     ? shaking_text(scene, *frame)
                                                : longest_shaking_text(scene);
        size = shaking_block(writer, scene, numbers, view, x, y);
    }
    if (kinds.drive) lines = frame ? drive_lines(scene, *frame) : longest_drive_lines(scene);
    for (const std::string& line : lines) {
        writer.write_below(size, x, y, line, writer.main(), writer.palette.ink);
    }
    if (scene.film.exaggerate == 1) return size;
    if (size.height > 0) size.height += 0.5 * writer.type.gap;
    const TextSize note = exaggeration_block(writer, scene.film, x, y + size.height);
    return {std::max(size.width, note.width), size.height + note.height};
}

TextSize exaggeration_block(const Writer& writer, const Film& film, double x, double y) {
    TextSize size;
    if (film.exaggerate == 1) return size;
    for (const std::string& line :
         {film.wording(Word::wall_motion),
          film.wording(Word::drawn_larger, {fmt::format("{:.3g}", film.exaggerate)})}) {
        writer.write_below(size, x, y, line, {writer.type.minor, true}, writer.palette.accent);
    }
    return size;
}

namespace {

std::int64_t count_in_tray(const State& frame) {
    const double floor = frame.floor().place.z();
    return std::count_if(frame.position.begin(), frame.position.end(),
                         [&](const Vec3& at) { return at.z() < floor; });
}

// The lines of the clock: the time first, then the lines below it.
std::vector<std::string> clock_lines(const FilmedScene& scene, const State& frame) {
    const WordKinds& kinds = scene.film.word_kinds;
    std::vector<std::string> lines;
    const bool known = !std::isnan(frame.time);
    if (kinds.time && known) lines.push_back(time_text(frame.time, scene.run.duration));
    const bool cycle = kinds.cycle && scene.drive.present && known;
    const Wording& say = scene.film.wording;
    if (cycle && frame.time < 0) {
        lines.push_back(say(Word::before_the_drive));
    } else if (cycle) {
        const ShownCycle shown = shown_cycle(frame);
        lines.push_back(say(Word::cycle, {std::to_string(shown.cycle)}));
        lines.push_back(say(Word::phase, {fmt::format("{:.2f}", shown.phase)}));
    }
    if (scene.container.tray && kinds.counts)
        lines.push_back(
            say(Word::in_the_tray, {std::to_string(count_in_tray(frame)), std::to_string(frame.size())}));
    return lines;
}

}  // namespace

std::string clock_words(const FilmedScene& scene, const State& frame) {
    return fmt::format("{}", fmt::join(clock_lines(scene, frame), "\n"));
}

TextSize clock_block(const Writer& writer, const FilmedScene& scene, const State& frame, double x, double y) {
    TextSize size;
    for (const std::string& line : clock_lines(scene, frame)) {
        const bool time = size.height == 0 && scene.film.word_kinds.time && !std::isnan(frame.time);
        writer.write_below(size, x, y, line, time ? writer.strong() : writer.minor(),
                           time ? writer.palette.ink : writer.palette.faint_ink);
    }
    return size;
}

TextSize widest_clock(const Writer& measure, const FilmedScene& scene) {
    TextSize size = clock_block(measure, scene, widest_frame(), 0, 0);
    if (!scene.container.tray || !scene.film.word_kinds.counts) return size;
    std::int64_t grains = 0;
    for (const Species& species : scene.species) grains += species.all();
    const std::string all = std::to_string(grains);
    const double counts =
        measure.write(0, 0, scene.film.wording(Word::in_the_tray, {all, all}), measure.minor(), {}).width;
    size.width = std::max(size.width, counts);
    return size;
}

TextSize note_block(const Writer& writer, const std::string& text, double x, double y, double wrap,
                    int most) {
    TextSize size;
    for (const std::string& line : lines_of(text))
        writer.write_below(size, x, y, line.empty() ? " " : line, writer.main(), writer.palette.ink, wrap,
                           most);
    return size;
}

}  // namespace grainreel
