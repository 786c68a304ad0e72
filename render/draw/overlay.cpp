#include "render/draw/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/measure/measure_table.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/measure_columns.hpp"
#include "render/draw/captions.hpp"

namespace grainreel {
TextSize static_part(const Writer& writer, const Scene& scene, const View* view, const PictureLayout& layout,
                     double width) {
    const TypeScale& type = writer.type;
    const double x = type.margin, inner = std::max(1.0, width - (layout.portrait ? 2.0 : 1.5) * type.margin);
    // The scale holds at the depth of the container's middle.
    const double scale = view ? view->pixels_per_metre(extent_of(scene).middle()) : 1;
    double y = type.margin;
    const TextSize title = title_block(writer, scene, x, y, inner);
    y += title.height + (title.height > 0 ? 1.2 * type.gap : 0);
    if (layout.portrait) {
        const TextSize legend = legend_block(writer, scene, x, y, 0.6 * inner);
        const double right = x + 0.66 * inner;
        const TextSize bar = scale_block(writer, scale, right, y + 0.4 * type.gap, 0.34 * inner);
        const double below = y + bar.height + 0.8 * type.gap;
        const TextSize axes = axes_block(writer, scene, view, right, below);
        y = std::max(y + legend.height, below - 0.4 * type.gap + axes.height);
        y += colour_bar_block(writer, scene, x, y, inner).height;
        return {width, y + marks_block(writer, scene, scale, x, y, inner).height};
    }
    y += legend_block(writer, scene, x, y, inner).height + type.gap;
    y += colour_bar_block(writer, scene, x, y, inner).height + type.gap;
    y += marks_block(writer, scene, scale, x, y, inner).height;
    const Writer measure{nullptr, type, writer.palette};
    const double longest = 0.8 * inner;
    const double below = axes_block(measure, scene, view, 0, 0).height +
                         arrows_block(measure, scene, view, 0, 0).height + type.gap +
                         scale_block(measure, scale, 0, 0, longest).height;
    if (layout.first.height > 0) y = std::max(y, layout.first.height - type.margin - below);
    y += axes_block(writer, scene, view, x, y).height;
    y += arrows_block(writer, scene, view, x, y).height + type.gap;
    y += scale_block(writer, scale, x, y, longest).height;
    return {width, y};
}

namespace {

double ground_alpha(const Scene& scene) {
    return scene.film.transparent ? 0 : 1;
}

}  // namespace

Overlay::Overlay(const Scene& scene, const Palette& palette, const PictureLayout& layout, const View& view)
    : scene_(scene),
      palette_(palette),
      layout_(layout),
      type_(type_scale(scene.film)),
      plan_(plan_numbers({nullptr, type_, palette_}, scene, layout.second.width, layout.second.height,
                         layout.portrait)),
      first_(blank_surface(layout.first, palette.background, ground_alpha(scene))),
      still_(blank_surface(layout.second, palette.background, ground_alpha(scene))),
      second_(blank_surface(layout.second, palette.background, ground_alpha(scene))) {
    draw_still(view);
    make_plots();
}

void Overlay::draw_still(const View& view) {
    first_ = blank_surface(layout_.first, palette_.background, ground_alpha(scene_));
    const CairoContext on(cairo_create(first_.get()));
    static_part({on.get(), type_, palette_}, scene_, &view, layout_, layout_.first.width);
    still_ = blank_surface(layout_.second, palette_.background, ground_alpha(scene_));
    draw_still_numbers(view);
    drawn_for_ = view;
    written_ = false;
}

void Overlay::draw_still_numbers(const View& view) {
    if (!scene_.drive.present) return;
    const CairoContext on(cairo_create(still_.get()));
    const Writer writer{on.get(), type_, palette_};
    dial_block(writer, scene_.drive, nullptr, plan_.radius, plan_.x, plan_.dial);
    drive_block(writer, scene_, plan_.drive_x, plan_.drive);
    if (layout_.portrait) arrows_block(writer, scene_, &view, plan_.arrows_x, plan_.drive);
}

void Overlay::make_plots() {
    std::vector<std::string> species;
    for (const Species& s : scene_.species) species.push_back(s.name);
    const std::vector<MeasureColumn> columns = measure_columns(species);
    for (std::size_t k = 0; k < plan_.plots.size(); ++k) {
        const FilmPlot& wanted = scene_.film.shows.plots[k];
        PlotFrame frame;
        frame.column = wanted.column;
        frame.label = wanted.label;
        for (const MeasureColumn& column : columns)
            if (column.name == wanted.column) frame.dimension = column.dimension;
        frame.time = {0, scene_.run.duration};
        frame.range = wanted.range;
        frame.width = plan_.plots[k].width;
        frame.height = plan_.plots[k].height;
        plots_.emplace_back(frame, type_, palette_);
    }
}

template <class Draw>
void Overlay::renew(Picture& picture, const Rectangle& part, const Draw& draw) {
    const CairoContext on(cairo_create(second_.get()));
    cairo_rectangle(on.get(), part.x, part.y, part.width, part.height);
    cairo_clip(on.get());
    cairo_set_operator(on.get(), CAIRO_OPERATOR_SOURCE);  // what was there goes, also without a background
    cairo_set_source_surface(on.get(), still_.get(), 0, 0);
    cairo_paint(on.get());
    cairo_set_operator(on.get(), CAIRO_OPERATOR_OVER);
    draw(on.get());
    copy_part(second_.get(), part, layout_.second.x, layout_.second.y, picture);
}

void Overlay::write(Picture& picture, const Frame& frame, const std::string& playback, const View& view) {
    // Axes, arrows and scale are as this view has them.
    if (view.eye != drawn_for_.eye || view.forward != drawn_for_.forward || view.focal != drawn_for_.focal)
        draw_still(view);
    if (!written_) {
        copy_surface(first_.get(), layout_.first, picture);
        copy_surface(still_.get(), layout_.second, picture);
    }
    const auto strip = [&](double from, double to) {
        const int top = static_cast<int>(from),
                  bottom = std::min(static_cast<int>(to), layout_.second.height);
        return Rectangle{0, top, layout_.second.width, std::max(0, bottom - top)};
    };
    const std::string clock = clock_words(scene_, frame), caption = playback_text(frame, playback);
    if (!written_ || clock != clock_)
        renew(picture, strip(0, plan_.clock_end), [&](cairo_t* on) {
            clock_block({on, type_, palette_}, scene_, frame, plan_.x, plan_.clock);
        });
    if (!written_ || caption != caption_)
        renew(picture, strip(plan_.caption, plan_.caption_end), [&](cairo_t* on) {
            const Writer writer{on, type_, palette_};
            if (!caption.empty())
                writer.write(plan_.x, plan_.caption, caption, writer.minor(), palette_.faint_ink, plan_.inner,
                             plan_.caption_lines);
        });
    const std::string note = note_of(frame);
    if (plan_.note_end > plan_.note && (!written_ || note != note_))
        renew(picture, strip(plan_.note, plan_.note_end), [&](cairo_t* on) {
            note_block({on, type_, palette_}, note, plan_.x, plan_.note + 0.5 * type_.gap, plan_.inner);
        });
    // The hand is drawn where the drive is; before the drive there is none.
    const double angle = frame.time < 0 ? -1 : frame.phase;
    const double stroke = frame.floor_offset.dot(scene_.drive.direction);
    if (scene_.drive.present && (!written_ || angle != angle_ || stroke != stroke_))
        renew(picture, strip(plan_.dial - 0.4 * type_.gap, plan_.dial_end), [&](cairo_t* on) {
            dial_block({on, type_, palette_}, scene_.drive, &frame, plan_.radius, plan_.x, plan_.dial);
        });
    renew_plots(picture, frame);
    written_ = true;
    clock_ = clock;
    caption_ = caption;
    note_ = note;
    angle_ = angle;
    stroke_ = stroke;
}

// With the values of the last row of measures until the frame.
std::string Overlay::note_of(const Frame& frame) const {
    return live_text(scene_.film.shows.live_words, [&](const std::string& name) -> std::optional<double> {
        if (!frame.measures || frame.measure_rows == 0) return std::nullopt;
        const std::vector<std::string>& columns = frame.measures->columns();
        const auto found = std::find(columns.begin(), columns.end(), name);
        GRAINREEL_CHECK(found != columns.end());
        return frame.measures
            ->values(static_cast<std::size_t>(found - columns.begin()), frame.measure_rows - 1,
                     frame.measure_rows)
            .front();
    });
}

void Overlay::renew_plots(Picture& picture, const Frame& frame) {
    for (std::size_t k = 0; k < plots_.size(); ++k) {
        Plot& plot = plots_[k];
        if (!plot.take(frame) && written_) continue;
        const Rectangle& part = plan_.plots[k];
        renew(picture, part, [&](cairo_t* on) { plot.draw(on, part.x, part.y); });
    }
}

}  // namespace grainreel
