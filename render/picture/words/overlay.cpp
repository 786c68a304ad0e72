// Writes and renews the words of a picture, and places labels beside grains.
#include "render/picture/words/overlay.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

Overlay::Overlay(const FilmedScene& scene, const Palette& palette, const PictureLayout& layout,
                 const View& view)
    : scene_(scene),
      palette_(palette),
      layout_(layout),
      type_(layout.type),
      plan_(plan_numbers({nullptr, type_, palette_}, scene, layout)),
      captions_(plan_captions(scene.film, layout.caption.width)),
      first_plates_(plates_around(
          first_part({nullptr, type_, palette_}, scene, &view, layout, layout.first.width).boxes, type_,
          layout.first)),
      second_plates_(plates_around(plan_.boxes, type_, layout.second)),
      first_(blank(layout.first, first_plates_)),
      still_(blank(layout.second, second_plates_)),
      second_(blank(layout.second, second_plates_)) {
    draw_still(view);
    make_plots();
}

std::vector<Rectangle> Overlay::moving() const {
    std::vector<Rectangle> parts{plan_.clock_part, plan_.caption_part, plan_.note_part};
    if (plan_.has_dial) parts.push_back(plan_.dial_part);
    if (plan_.drive_part.height > 0) parts.push_back(plan_.drive_part);
    parts.insert(parts.end(), plan_.plots.begin(), plan_.plots.end());
    for (Rectangle& part : parts) part.x += layout_.second.x, part.y += layout_.second.y;
    if (layout_.caption.height > 0) parts.push_back(layout_.caption);
    return parts;
}

CairoSurface Overlay::blank(const Rectangle& part, const std::vector<Rectangle>& plates) const {
    const bool clear = scene_.film.transparent || layout_.plates;
    CairoSurface surface = blank_surface(part, palette_.background, clear ? 0 : 1);
    if (!layout_.plates) return surface;
    paint_plates(CairoContext(cairo_create(surface.get())).get(), plates, type_, palette_);
    return surface;
}

void Overlay::draw_still(const View& view) {
    first_ = blank(layout_.first, first_plates_);
    const CairoContext on(cairo_create(first_.get()));
    first_part({on.get(), type_, palette_}, scene_, &view, layout_, layout_.first.width);
    still_ = blank(layout_.second, second_plates_);
    const CairoContext on_still(cairo_create(still_.get()));
    draw_still_numbers({on_still.get(), type_, palette_}, view);
    drawn_for_ = view;
    written_ = false;
    static std::atomic<std::uint64_t> numbers{0};
    still_number_ = ++numbers;
}

void Overlay::draw_still_numbers(const Writer& writer, const View& view) const {
    if (!scene_.drive.present) return;
    if (plan_.has_dial)
        dial_block(writer, scene_.drive, nullptr, plan_.radius, plan_.dial.x, plan_.dial.y, &view);
    if (!drive_lines_change(scene_.drive))
        drive_block(writer, scene_, nullptr, &view, plan_.drive.x, plan_.drive.y);
    if (layout_.stacked && plan_.has_arrows)
        arrows_block(writer, scene_, &view, plan_.arrows.x, plan_.arrows.y);
}

void Overlay::make_plots() {
    for (std::size_t k = 0; k < plan_.plots.size(); ++k) {
        const FilmPlot& plot = scene_.film.shows.plots[k];
        plots_.push_back(make_side_plot(scene_, plot, plan_.plots[k], scene_.run.duration, type_, palette_));
    }
}

void Overlay::put(cairo_surface_t* from, const Rectangle& part, const Rectangle& gutter,
                  Picture& picture) const {
    if (scene_.film.transparent)
        copy_part_on_halo(from, part, gutter.x, gutter.y, halo_of(type_, palette_), picture);
    else
        copy_part(from, part, gutter.x, gutter.y, picture);
}

template <class Draw>
void Overlay::renew(Picture& picture, const Rectangle& part, const Draw& draw) {
    const CairoContext on(cairo_create(second_.get()));
    cairo_rectangle(on.get(), part.x, part.y, part.width, part.height);
    cairo_clip(on.get());
    cairo_set_operator(on.get(),
                       CAIRO_OPERATOR_SOURCE);  // replaces the pixels, by clear ones too
    cairo_set_source_surface(on.get(), still_.get(), 0, 0);
    cairo_paint(on.get());
    cairo_set_operator(on.get(), CAIRO_OPERATOR_OVER);
    draw(on.get());
    if (!layout_.plates) put(second_.get(), part, layout_.second, picture);
}

std::vector<Overlay::Changing> Overlay::changing(const Shot& frame, const std::string& playback,
                                                 const View& view) const {
    const std::string pace = playback_text(scene_.film, frame, playback), note = note_text(scene_, frame);
    std::vector<Changing> all;
    all.push_back({plan_.clock_part, clock_words(scene_, frame), [this, &frame](const Writer& writer) {
                       clock_block(writer, scene_, frame, plan_.clock.x, plan_.clock.y);
                   }});
    all.push_back({plan_.caption_part, pace, [this, pace](const Writer& writer) {
                       if (!pace.empty())
                           writer.write(plan_.caption.x, plan_.caption.y, pace, writer.minor(),
                                        palette_.faint_ink, plan_.caption_wrap, plan_.caption_lines);
                   }});
    if (plan_.note_part.height > 0)
        all.push_back({plan_.note_part, note, [this, note](const Writer& writer) {
                           note_block(writer, note, plan_.note.x, plan_.note.y + 0.5 * type_.gap,
                                      plan_.note_wrap, note_lines);
                       }});
    if (plan_.drive_part.height > 0)
        all.push_back(
            {plan_.drive_part,
             scene_.drive.present ? fmt::format("{}", fmt::join(drive_lines(scene_, frame), "\n")) : "",
             [this, &frame, &view](const Writer& writer) {
                 drive_block(writer, scene_, &frame, &view, plan_.drive.x, plan_.drive.y);
             }});
    // The hand shows the phase of the drive. Before the drive begins there is no hand.
    const double angle = frame.time < 0 ? -1 : frame.phase;
    const double stroke = frame.floor().place.dot(scene_.drive.direction);
    if (plan_.has_dial)
        all.push_back({plan_.dial_part, fmt::format("{} {}", angle, stroke),
                       [this, &frame, &view](const Writer& writer) {
                           dial_block(writer, scene_.drive, &frame, plan_.radius, plan_.dial.x, plan_.dial.y,
                                      &view);
                       }});
    return all;
}

void Overlay::write(Picture& picture, const Shot& frame, const std::string& playback, const View& view) {
    // Axes, arrows and scale depend on the view.
    if (view.eye != drawn_for_.eye || view.forward != drawn_for_.forward || view.focal != drawn_for_.focal)
        draw_still(view);
    if (!written_ && layout_.plates) {
        const CairoContext on(cairo_create(second_.get()));
        cairo_set_operator(on.get(), CAIRO_OPERATOR_SOURCE);
        cairo_set_source_surface(on.get(), still_.get(), 0, 0);
        cairo_paint(on.get());
    } else if (!written_) {
        put(first_.get(), {0, 0, layout_.first.width, layout_.first.height}, layout_.first, picture);
        put(still_.get(), {0, 0, layout_.second.width, layout_.second.height}, layout_.second, picture);
    }
    const std::vector<Changing> words = changing(frame, playback, view);
    now_.resize(words.size());
    for (std::size_t k = 0; k < words.size(); ++k) {
        if (written_ && words[k].now == now_[k]) continue;
        renew(picture, words[k].part, [&](cairo_t* on) { words[k].draw({on, type_, palette_}); });
        now_[k] = words[k].now;
    }
    renew_plots(picture, frame);
    renew_caption(picture, frame);
    written_ = true;
}

void Overlay::leave_out(Picture& picture) {
    const Rectangle all{0, 0, picture.width, picture.height};
    copy_surface(blank_surface(all, palette_.background, scene_.film.transparent ? 0 : 1).get(), all,
                 picture);
    written_ = false;
}

void Overlay::draw_on(cairo_t* on, const Shot& frame, const std::string& playback, const View& view) {
    const Writer writer{on, type_, palette_};
    draw_part(on, layout_.first, [&] {
        if (layout_.plates) paint_plates(on, first_plates_, type_, palette_);
        first_part(writer, scene_, &view, layout_, layout_.first.width);
    });
    draw_part(on, layout_.second, [&] {
        if (layout_.plates) paint_plates(on, second_plates_, type_, palette_);
        draw_still_numbers(writer, view);
        for (const Changing& words : changing(frame, playback, view)) words.draw(writer);
        for (std::size_t k = 0; k < plots_.size(); ++k) {
            plots_[k]->take(frame);
            plots_[k]->draw(on, plan_.plots[k].x, plan_.plots[k].y);
        }
    });
    if (layout_.caption.height > 0)
        draw_part(on, layout_.caption, [&] {
            draw_caption(writer, captions_, caption_at(scene_.film, scene_.run.duration, frame),
                         layout_.caption.width);
        });
}

void Overlay::renew_caption(Picture& picture, const Shot& frame) {
    const Rectangle& band = layout_.caption;
    const std::string caption = caption_at(scene_.film, scene_.run.duration, frame);
    if (band.height <= 0 || (written_ && caption == caption_)) return;
    caption_ = caption;
    const CairoSurface surface = blank_surface(band, palette_.background, scene_.film.transparent ? 0 : 1);
    const CairoContext on(cairo_create(surface.get()));
    draw_caption({on.get(), type_, palette_}, captions_, caption, band.width);
    const Rectangle all{0, 0, band.width, band.height};
    put(surface.get(), all, band, picture);
}

void Overlay::lay_over(Picture& picture) const {
    if (!layout_.plates) return;
    lay_plates(first_.get(), first_plates_, layout_.first, picture);
    lay_plates(second_.get(), second_plates_, layout_.second, picture);
}

void Overlay::renew_plots(Picture& picture, const Shot& frame) {
    for (std::size_t k = 0; k < plots_.size(); ++k) {
        SidePlot& plot = *plots_[k];
        if (!plot.take(frame) && written_) continue;
        const Rectangle& part = plan_.plots[k];
        renew(picture, part, [&](cairo_t* on) { plot.draw(on, part.x, part.y); });
    }
}

namespace {

struct Placed {
    const FilmLabel* label;
    double x, y, radius;  // pixels of the port: centre and radius of the grain
    Rectangle box;        // box of the words, in the port
};

bool overlap(const Rectangle& a, const Rectangle& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::optional<Placed> placed(const FilmLabel& label, const State& frame, const View& view,
                             const TextStyle& style, double gap) {
    const std::optional<std::size_t> row = frame.row_of(label.id);
    if (!row) return std::nullopt;
    const Vec3& at = frame.position[*row];
    if (!view.orthographic && view.to_view(at).z() <= 0) return std::nullopt;
    const Eigen::Vector2d centre = view.project(at);
    const bool inside =
        centre.x() >= 0 && centre.y() >= 0 && centre.x() <= view.port.width && centre.y() <= view.port.height;
    if (!inside) return std::nullopt;
    const double radius = frame.radius[*row] * view.pixels_per_metre(at);
    const TextSize size = measure_text(label.text, style);
    Placed one{&label, centre.x(), centre.y(), radius, {}};
    one.box = {static_cast<int>(centre.x() + radius + gap), static_cast<int>(centre.y() - 0.5 * size.height),
               static_cast<int>(std::ceil(size.width)) + 1, static_cast<int>(std::ceil(size.height)) + 1};
    // Where there is no room to the right, the words stand to the left.
    if (one.box.x + one.box.width + gap > view.port.width)
        one.box.x = static_cast<int>(centre.x() - radius - gap) - one.box.width;
    one.box.x = std::clamp(one.box.x, 0, std::max(0, view.port.width - one.box.width));
    one.box.y = std::clamp(one.box.y, 0, std::max(0, view.port.height - one.box.height));
    return one;
}

}  // namespace

void write_grain_labels(cairo_t* on, const FilmedScene& scene, const State& frame, const View& view,
                        const TypeScale& type, const Palette& palette, std::vector<char>& found) {
    const TextStyle style{type.main, false};
    std::vector<Placed> all;
    found.resize(scene.film.labels.size());
    for (std::size_t k = 0; k < scene.film.labels.size(); ++k) {
        const FilmLabel& label = scene.film.labels[k];
        if (frame.row_of(label.id)) found[k] = 1;
        std::optional<Placed> one = placed(label, frame, view, style, 0.6 * type.main);
        if (!one) continue;
        for (const Placed& other : all)
            if (overlap(one->box, other.box)) one->box.y = other.box.y + other.box.height + 2;
        one->box.y = std::min(one->box.y, std::max(0, view.port.height - one->box.height));
        all.push_back(*one);
    }
    std::vector<WordBox> boxes;
    for (const Placed& one : all) {
        boxes.push_back({static_cast<double>(one.box.x), static_cast<double>(one.box.y),
                         static_cast<double>(one.box.width), static_cast<double>(one.box.height)});
        // The line goes from the grain's rim to the nearer side of the plate.
        const double end_x = one.box.x > one.x ? one.box.x : one.box.x + one.box.width;
        const double end_y = one.box.y + 0.5 * one.box.height;
        const double length = std::max(1e-9, std::hypot(end_x - one.x, end_y - one.y));
        const double rim = std::min(1.0, one.radius / length);
        cairo_move_to(on, one.x + rim * (end_x - one.x), one.y + rim * (end_y - one.y));
        cairo_line_to(on, end_x, end_y);
    }
    set_colour(on, palette.ink);
    cairo_set_line_width(on, std::max(1.0, type.main / 14));
    cairo_stroke(on);
    paint_plates(on, plates_around(boxes, type, {0, 0, view.port.width, view.port.height}), type, palette);
    for (const Placed& one : all) draw_text(on, one.box.x, one.box.y, one.label->text, style, palette.ink);
}

void draw_grain_labels(const FilmedScene& scene, const State& frame, const View& view,
                       const PictureLayout& layout, const Palette& palette, Picture& picture,
                       std::vector<char>& found) {
    const Rectangle port{0, 0, view.port.width, view.port.height};
    const CairoSurface surface = blank_surface(port, palette.background, 0);
    {
        const CairoContext on(cairo_create(surface.get()));
        write_grain_labels(on.get(), scene, frame, view, layout.type, palette, found);
    }
    lay_plates(surface.get(), {port}, layout.port, picture);
}

std::string missing_labels(const FilmedScene& scene, const std::vector<char>& found) {
    std::string words;
    for (std::size_t k = 0; k < found.size(); ++k)
        if (found[k] == 0)
            words += fmt::format("{}label \"{}\": no grain has had the id {}", words.empty() ? "" : "; ",
                                 scene.film.labels[k].text, scene.film.labels[k].id);
    return words;
}

}  // namespace grainreel
