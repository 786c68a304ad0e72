#include "render/draw/overlay.hpp"

#include "engine/scene/bed.hpp"

#include <algorithm>

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
        return {width, std::max(y + legend.height, below - 0.4 * type.gap + axes.height)};
    }
    const TextSize legend = legend_block(writer, scene, x, y, inner);
    y += legend.height + type.gap;
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

TextSize changing_part(const Writer& writer, const Scene& scene, const View* view, const Frame& frame,
                       const std::string& playback, double width, bool portrait) {
    const TypeScale& type = writer.type;
    const bool dial = scene.drive.present;
    const double x = portrait ? type.margin : 0.5 * type.margin;
    const double inner = std::max(1.0, width - (portrait ? 2.0 : 1.5) * type.margin);
    const double radius = portrait ? std::min(2.2 * type.main, 0.14 * inner) : 2.2 * type.main;
    const std::string caption = playback_text(frame, playback);
    const auto write_caption = [&](double y) {
        if (caption.empty()) return TextSize{};
        return writer.write(x, y, caption, writer.minor(), writer.palette.faint_ink, inner, portrait ? 2 : 4);
    };
    double y = type.margin;
    const TextSize clock = clock_block(writer, scene, frame, x, y);
    y += clock.height + 0.3 * type.gap;
    TextSize size{clock.width, 0};
    if (portrait) {
        // Two lines are kept for the caption, whatever it says, so that nothing moves.
        write_caption(y);
        y += 2.6 * type.minor + type.gap;
        if (dial) {
            const TextSize disc = dial_block(writer, scene.drive, nullptr, radius, x, y);
            dial_block(writer, scene.drive, &frame, radius, x, y);
            const TextSize drive = drive_block(writer, scene, x + disc.width + type.gap, y);
            arrows_block(writer, scene, view, x + disc.width + drive.width + 3 * type.gap, y);
            y += std::max(disc.height, drive.height);
        }
        return {width, y - type.margin};
    }
    if (dial) {
        y += 0.6 * type.gap;
        const TextSize disc = dial_block(writer, scene.drive, nullptr, radius, x, y);
        dial_block(writer, scene.drive, &frame, radius, x, y);
        y += disc.height + 0.6 * type.gap;
        const TextSize drive = drive_block(writer, scene, x, y);
        y += drive.height + type.gap;
        size.width = std::max({size.width, disc.width, drive.width});
    }
    y += write_caption(y).height;
    return {size.width, y - type.margin};
}

Overlay::Overlay(const Scene& scene, const Palette& palette, const PictureLayout& layout, const View& view)
    : scene_(scene),
      palette_(palette),
      layout_(layout),
      type_(type_scale(scene.film)),
      first_(blank_surface(layout.first, palette.background)),
      second_(blank_surface(layout.second, palette.background)) {
    draw_first(view);
}

void Overlay::draw_first(const View& view) {
    first_ = blank_surface(layout_.first, palette_.background);
    const CairoContext on(cairo_create(first_.get()));
    static_part({on.get(), type_, palette_}, scene_, &view, layout_, layout_.first.width);
    drawn_for_ = view;
    first_written_ = false;
}

void Overlay::write(Picture& picture, const Frame& frame, const std::string& playback, const View& view) {
    // Axes, arrows and scale are as this view has them.
    if (view.eye != drawn_for_.eye || view.forward != drawn_for_.forward || view.focal != drawn_for_.focal)
        draw_first(view);
    if (!first_written_) copy_surface(first_.get(), layout_.first, picture);
    first_written_ = true;
    const CairoContext on(cairo_create(second_.get()));
    fill_surface(on.get(), palette_.background);
    changing_part({on.get(), type_, palette_}, scene_, &view, frame, playback, layout_.second.width,
                  layout_.portrait);
    copy_surface(second_.get(), layout_.second, picture);
}

}  // namespace grainreel
