#include "render/picture/words/overlay.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/words/captions.hpp"
#include "render/picture/words/gutters.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

Overlay::Overlay(const FilmedScene& scene, const Palette& palette, const PictureLayout& layout,
                 const View& view)
    : scene_(scene),
      palette_(palette),
      layout_(layout),
      type_(layout.type),
      plan_(plan_numbers({nullptr, type_, palette_}, scene, layout.second.width, layout.second.height,
                         layout.stacked)),
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
    draw_still_numbers(view);
    drawn_for_ = view;
    written_ = false;
    static std::atomic<std::uint64_t> numbers{0};
    still_number_ = ++numbers;
}

void Overlay::draw_still_numbers(const View& view) {
    if (!scene_.drive.present) return;
    const CairoContext on(cairo_create(still_.get()));
    const Writer writer{on.get(), type_, palette_};
    if (plan_.has_dial)
        dial_block(writer, scene_.drive, nullptr, plan_.radius, plan_.dial.x, plan_.dial.y, &view);
    if (!drive_lines_change(scene_.drive)) drive_block(writer, scene_, nullptr, plan_.drive.x, plan_.drive.y);
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
                       CAIRO_OPERATOR_SOURCE);  // replaces what was there, also without a background
    cairo_set_source_surface(on.get(), still_.get(), 0, 0);
    cairo_paint(on.get());
    cairo_set_operator(on.get(), CAIRO_OPERATOR_OVER);
    draw(on.get());
    if (!layout_.plates) put(second_.get(), part, layout_.second, picture);
}

void Overlay::write(Picture& picture, const Frame& frame, const std::string& playback, const View& view) {
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
    const std::string clock = clock_words(scene_, frame),
                      caption = playback_text(scene_.film, frame, playback);
    if (!written_ || clock != clock_)
        renew(picture, plan_.clock_part, [&](cairo_t* on) {
            clock_block({on, type_, palette_}, scene_, frame, plan_.clock.x, plan_.clock.y);
        });
    if (!written_ || caption != caption_)
        renew(picture, plan_.caption_part, [&](cairo_t* on) {
            const Writer writer{on, type_, palette_};
            if (!caption.empty())
                writer.write(plan_.caption.x, plan_.caption.y, caption, writer.minor(), palette_.faint_ink,
                             plan_.caption_wrap, plan_.caption_lines);
        });
    const std::string note = note_text(scene_, frame);
    if (plan_.note_part.height > 0 && (!written_ || note != note_))
        renew(picture, plan_.note_part, [&](cairo_t* on) {
            note_block({on, type_, palette_}, note, plan_.note.x, plan_.note.y + 0.5 * type_.gap,
                       plan_.note_wrap, note_lines(scene_));
        });
    const std::string drive = fmt::format("{}", fmt::join(drive_lines(scene_, frame), "\n"));
    if (plan_.drive_part.height > 0 && (!written_ || drive != drive_))
        renew(picture, plan_.drive_part, [&](cairo_t* on) {
            drive_block({on, type_, palette_}, scene_, &frame, plan_.drive.x, plan_.drive.y);
        });
    // The hand shows the phase of the drive. Before the drive begins there is no hand.
    const double angle = frame.time < 0 ? -1 : frame.phase;
    const double stroke = frame.floor().place.dot(scene_.drive.direction);
    if (plan_.has_dial && (!written_ || angle != angle_ || stroke != stroke_))
        renew(picture, plan_.dial_part, [&](cairo_t* on) {
            dial_block({on, type_, palette_}, scene_.drive, &frame, plan_.radius, plan_.dial.x, plan_.dial.y,
                       &view);
        });
    renew_plots(picture, frame);
    written_ = true;
    clock_ = clock;
    caption_ = caption;
    note_ = note;
    drive_ = drive;
    angle_ = angle;
    stroke_ = stroke;
}

void Overlay::lay_over(Picture& picture) const {
    if (!layout_.plates) return;
    lay_plates(first_.get(), first_plates_, layout_.first, picture);
    lay_plates(second_.get(), second_plates_, layout_.second, picture);
}

void Overlay::renew_plots(Picture& picture, const Frame& frame) {
    for (std::size_t k = 0; k < plots_.size(); ++k) {
        SidePlot& plot = *plots_[k];
        if (!plot.take(frame) && written_) continue;
        const Rectangle& part = plan_.plots[k];
        renew(picture, part, [&](cairo_t* on) { plot.draw(on, part.x, part.y); });
    }
}

}  // namespace grainreel
