#include "render/picture/words/grain_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "render/picture/base/cairo_text.hpp"
#include "render/picture/grains/shown_grains.hpp"

namespace grainreel {

namespace {

struct Placed {
    const FilmLabel* label;
    double x, y, radius;  // pixels of the port: of the grain
    Rectangle box;        // of the words, in the port
};

bool overlap(const Rectangle& a, const Rectangle& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::optional<Placed> placed(const FilmLabel& label, const Frame& frame, const View& view,
                             const TextStyle& style, double gap) {
    const std::optional<std::size_t> row = find_grain(frame, label.id);
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

void draw_grain_labels(const FilmedScene& scene, const Frame& frame, const View& view,
                       const PictureLayout& layout, const Palette& palette, Picture& picture,
                       std::vector<char>& found) {
    const TypeScale& type = layout.type;
    const TextStyle style{type.main, false};
    std::vector<Placed> all;
    found.resize(scene.film.labels.size());
    for (std::size_t k = 0; k < scene.film.labels.size(); ++k) {
        const FilmLabel& label = scene.film.labels[k];
        if (find_grain(frame, label.id)) found[k] = 1;
        std::optional<Placed> one = placed(label, frame, view, style, 0.6 * type.main);
        if (!one) continue;
        for (const Placed& other : all)
            if (overlap(one->box, other.box)) one->box.y = other.box.y + other.box.height + 2;
        one->box.y = std::min(one->box.y, std::max(0, view.port.height - one->box.height));
        all.push_back(*one);
    }
    if (all.empty()) return;
    const Rectangle port{0, 0, view.port.width, view.port.height};
    const CairoSurface surface = blank_surface(port, palette.background, 0);
    std::vector<WordBox> boxes;
    for (const Placed& one : all)
        boxes.push_back({static_cast<double>(one.box.x), static_cast<double>(one.box.y),
                         static_cast<double>(one.box.width), static_cast<double>(one.box.height)});
    std::vector<Rectangle> laid = plates_around(boxes, type, port);
    {
        const CairoContext on(cairo_create(surface.get()));
        for (const Placed& one : all) {
            // From the grain's rim to the plate's nearer side.
            const double end_x = one.box.x > one.x ? one.box.x : one.box.x + one.box.width;
            const double end_y = one.box.y + 0.5 * one.box.height;
            const double length = std::max(1e-9, std::hypot(end_x - one.x, end_y - one.y));
            const double rim = std::min(1.0, one.radius / length);
            cairo_move_to(on.get(), one.x + rim * (end_x - one.x), one.y + rim * (end_y - one.y));
            cairo_line_to(on.get(), end_x, end_y);
        }
        set_colour(on.get(), palette.ink);
        cairo_set_line_width(on.get(), std::max(1.0, type.main / 14));
        cairo_stroke(on.get());
        paint_plates(on.get(), laid, type, palette);
        for (const Placed& one : all)
            draw_text(on.get(), one.box.x, one.box.y, one.label->text, style, palette.ink);
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
