#include "render/draw/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/measure/measure_table.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/measure_columns.hpp"
#include "render/draw/captions.hpp"

namespace grainreel {
namespace {

constexpr double endless_room = 1e9;  // pixels

// Blocks that are put below each other while there is room.
class Column {
  public:
    Column(double x, double y, double room, FirstPart& part)
        : box_{x, y, 0, 0}, y_(y), room_(room), part_(part) {}
    // block(x, y, writer), with a writer that measures first. Left out whole when it does not fit.
    template <class Block>
    void add(const Writer& writer, const char* name, double gap_before, const Block& block) {
        const Writer measure{nullptr, writer.type, writer.palette};
        const TextSize size = block(measure, box_.x, y_);
        if (size.height <= 0) return;
        const double y = y_ > box_.y ? y_ + gap_before : y_;
        if (y + size.height > room_) {
            part_.left_out.emplace_back(name);
            return;
        }
        block(writer, box_.x, y);
        box_.width = std::max(box_.width, size.width);
        y_ = y + size.height;
    }
    double end() const { return y_; }
    WordBox box() const { return {box_.x, box_.y, box_.width, y_ - box_.y}; }

  private:
    WordBox box_;
    double y_;
    const double room_;
    FirstPart& part_;
};

// Title; legend beside scale and axes; colour bar beside marks. Axes are the first to be left out.
FirstPart portrait_part(const Writer& writer, const Scene& scene, const View* view, double scale,
                        double inner, double room) {
    const TypeScale& type = writer.type;
    const Writer measure{nullptr, type, writer.palette};
    const double x = type.margin, aside = 0.24 * inner;
    const bool both = scene.film.shows.colour.by != GrainValue::species &&
                      marks_block(measure, scene, scale, 0, 0, inner).height > 0;
    const double half = both ? 0.5 * (inner - 2 * type.gap) : inner;
    const auto axes = [&](const Writer& on, double at, double y) {
        return axes_block(on, scene, view, at, y);
    };
    const auto colours = [&](const Writer& on, double at, double y) {
        return colour_bar_block(on, scene, at, y, half);
    };
    const auto marks = [&](const Writer& on, double at, double y) {
        return marks_block(on, scene, scale, at, y, half);
    };
    FirstPart part;
    Column top(x, type.margin, room, part);
    top.add(writer, "title", 0,
            [&](const Writer& on, double at, double y) { return title_block(on, scene, at, y, inner); });
    const double second = top.end() + (top.end() > type.margin ? 1.2 * type.gap : 0);
    Column left(x, second, room, part), right(x + inner - aside, second + 0.4 * type.gap, room, part);
    left.add(writer, "legend", 0, [&](const Writer& on, double at, double y) {
        return legend_block(on, scene, at, y, inner - aside - type.gap);
    });
    right.add(writer, "scale bar", 0,
              [&](const Writer& on, double at, double y) { return scale_block(on, scale, at, y, aside); });
    const double last = std::max(colours(measure, 0, 0).height, marks(measure, 0, 0).height);
    const double axes_room = right.end() + 0.4 * type.gap + axes(measure, 0, 0).height + last;
    if (axes_room <= room)
        right.add(writer, "axes", 0.4 * type.gap, axes);
    else if (scene.film.axes)
        part.left_out.emplace_back("axes");
    const double third = std::max(left.end(), right.end());
    Column lower_left(x, third, room, part),
        lower_right(both ? x + half + 2 * type.gap : x, third, room, part);
    lower_left.add(writer, "colour bar", 0, colours);
    lower_right.add(writer, "marks", 0, marks);
    part.height = std::max(lower_left.end(), lower_right.end());
    part.boxes = {{x, type.margin, inner, part.height - type.margin}};
    return part;
}

// What says what is seen at the upper end, what says where and how large at the lower one.
FirstPart landscape_part(const Writer& writer, const Scene& scene, const View* view, double scale,
                         double inner, double room) {
    const TypeScale& type = writer.type;
    const Writer measure{nullptr, type, writer.palette};
    const double x = type.margin, longest = 0.8 * inner;
    const auto axes = [&](const Writer& on, double at, double y) {
        return axes_block(on, scene, view, at, y);
    };
    const auto arrows = [&](const Writer& on, double at, double y) {
        return arrows_block(on, scene, view, at, y);
    };
    const auto length = [&](const Writer& on, double at, double y) {
        return scale_block(on, scale, at, y, longest);
    };
    const auto height = [&](const auto& block) { return block(measure, 0, 0).height; };
    double below = height(length) + (height(arrows) > 0 ? height(arrows) + type.gap : 0);
    FirstPart part;
    Column upper(x, type.margin, room - below, part);
    upper.add(writer, "title", 0,
              [&](const Writer& on, double at, double y) { return title_block(on, scene, at, y, inner); });
    upper.add(writer, "legend", 1.2 * type.gap,
              [&](const Writer& on, double at, double y) { return legend_block(on, scene, at, y, inner); });
    upper.add(writer, "colour bar", type.gap, [&](const Writer& on, double at, double y) {
        return colour_bar_block(on, scene, at, y, inner);
    });
    upper.add(writer, "marks", type.gap, [&](const Writer& on, double at, double y) {
        return marks_block(on, scene, scale, at, y, inner);
    });
    const bool axes_fit = upper.end() + height(axes) <= room - below;
    if (axes_fit) below += height(axes);
    const bool endless = room >= endless_room;
    Column lower(x, endless ? upper.end() + type.gap : room - below, room, part);
    if (axes_fit)
        lower.add(writer, "axes", 0, axes);
    else
        part.left_out.emplace_back("axes");
    lower.add(writer, "arrows", 0, arrows);
    lower.add(writer, "scale bar", type.gap, length);
    part.height = lower.end();
    part.boxes = {upper.box(), lower.box()};
    return part;
}

}  // namespace

FirstPart first_part(const Writer& writer, const Scene& scene, const View* view, const PictureLayout& layout,
                     double width) {
    const TypeScale& type = writer.type;
    const double inner = std::max(1.0, width - (layout.portrait ? 2.0 : 1.5) * type.margin);
    const double room = layout.first.height > 0 ? layout.first.height - type.margin : endless_room;
    // The scale holds at the depth of the container's middle.
    const double scale = view ? view->pixels_per_metre(extent_of(scene).middle()) : 1;
    return (layout.portrait ? portrait_part : landscape_part)(writer, scene, view, scale, inner, room);
}

namespace {

// Whole pixels around each box, inside the gutter.
std::vector<Rectangle> plates_around(const std::vector<WordBox>& boxes, const TypeScale& type,
                                     const Rectangle& gutter) {
    const double room = 0.45 * type.margin;
    std::vector<Rectangle> plates;
    for (const WordBox& box : boxes) {
        const int left = std::max(0, static_cast<int>(box.x - room)),
                  top = std::max(0, static_cast<int>(box.y - room)),
                  right = std::min(gutter.width, static_cast<int>(std::ceil(box.x + box.width + room))),
                  bottom = std::min(gutter.height, static_cast<int>(std::ceil(box.y + box.height + room)));
        plates.push_back({left, top, right - left, bottom - top});
    }
    return plates;
}

std::vector<WordBox> boxes_of(const NumbersPlan& plan, bool portrait) {
    if (portrait) return {{plan.x, plan.clock, plan.inner, plan.height - plan.clock}};
    std::vector<WordBox> boxes{{plan.x, plan.clock, plan.inner, plan.note_end - plan.clock}};
    if (plan.plots.empty()) return boxes;
    const Rectangle &top = plan.plots.front(), &low = plan.plots.back();
    boxes.push_back({1.0 * top.x, 1.0 * top.y, 1.0 * top.width, 1.0 * (low.y + low.height - top.y)});
    return boxes;
}

void rounded(cairo_t* on, const Rectangle& box, double radius) {
    constexpr double quarter = 0.5 * std::numbers::pi;
    cairo_new_sub_path(on);
    cairo_arc(on, box.x + box.width - radius, box.y + radius, radius, -quarter, 0);
    cairo_arc(on, box.x + box.width - radius, box.y + box.height - radius, radius, 0, quarter);
    cairo_arc(on, box.x + radius, box.y + box.height - radius, radius, quarter, 2 * quarter);
    cairo_arc(on, box.x + radius, box.y + radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(on);
}

// One byte of a pixel over another, with alphas of 0 to 255; the upper one is multiplied by its alpha.
void lay_pixel(std::uint32_t upper, std::uint8_t* out) {
    const unsigned alpha = upper >> 24;
    if (alpha == 0) return;
    const double left = out[3] * (255.0 - alpha) / 255, all = alpha + left;
    for (int c = 0; c < 3; ++c) {
        const unsigned own = (upper >> (16 - 8 * c)) & 255;
        out[c] = static_cast<std::uint8_t>(std::min(255.0, (255 * own + out[c] * left) / all + 0.5));
    }
    out[3] = static_cast<std::uint8_t>(all + 0.5);
}

void lay_part(cairo_surface_t* from, const Rectangle& part, const Rectangle& gutter, Picture& picture) {
    cairo_surface_flush(from);
    const unsigned char* pixels = cairo_image_surface_get_data(from);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(from));
    for (int y = part.y; y < part.y + part.height; ++y) {
        const auto* row =
            reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(y) * stride);
        for (int x = part.x; x < part.x + part.width; ++x)
            lay_pixel(row[x], picture.pixel(gutter.x + x, gutter.y + y));
    }
}

}  // namespace

Overlay::Overlay(const Scene& scene, const Palette& palette, const PictureLayout& layout, const View& view)
    : scene_(scene),
      palette_(palette),
      layout_(layout),
      type_(type_scale(scene.film)),
      plan_(plan_numbers({nullptr, type_, palette_}, scene, layout.second.width, layout.second.height,
                         layout.portrait)),
      first_plates_(plates_around(
          first_part({nullptr, type_, palette_}, scene, &view, layout, layout.first.width).boxes, type_,
          layout.first)),
      second_plates_(plates_around(boxes_of(plan_, layout.portrait), type_, layout.second)),
      first_(blank(layout.first, first_plates_)),
      still_(blank(layout.second, second_plates_)),
      second_(blank(layout.second, second_plates_)) {
    draw_still(view);
    make_plots();
}

CairoSurface Overlay::blank(const Rectangle& part, const std::vector<Rectangle>& plates) const {
    const bool clear = scene_.film.transparent || layout_.plates;
    CairoSurface surface = blank_surface(part, palette_.background, clear ? 0 : 1);
    if (!layout_.plates) return surface;
    const CairoContext on(cairo_create(surface.get()));
    cairo_set_source_rgba(on.get(), palette_.background.red, palette_.background.green,
                          palette_.background.blue, plate_strength(palette_));
    for (const Rectangle& plate : plates) rounded(on.get(), plate, 0.3 * type_.main);
    cairo_fill(on.get());
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
}

void Overlay::draw_still_numbers(const View& view) {
    if (!scene_.drive.present) return;
    const CairoContext on(cairo_create(still_.get()));
    const Writer writer{on.get(), type_, palette_};
    if (plan_.has_dial) dial_block(writer, scene_.drive, nullptr, plan_.radius, plan_.x, plan_.dial);
    drive_block(writer, scene_, plan_.drive_x, plan_.drive);
    if (layout_.portrait && plan_.has_arrows)
        arrows_block(writer, scene_, &view, plan_.arrows_x, plan_.drive);
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
    if (!layout_.plates) copy_part(second_.get(), part, layout_.second.x, layout_.second.y, picture);
}

void Overlay::write(Picture& picture, const Frame& frame, const std::string& playback, const View& view) {
    // Axes, arrows and scale are as this view has them.
    if (view.eye != drawn_for_.eye || view.forward != drawn_for_.forward || view.focal != drawn_for_.focal)
        draw_still(view);
    if (!written_ && layout_.plates) {
        const CairoContext on(cairo_create(second_.get()));
        cairo_set_operator(on.get(), CAIRO_OPERATOR_SOURCE);
        cairo_set_source_surface(on.get(), still_.get(), 0, 0);
        cairo_paint(on.get());
    } else if (!written_) {
        copy_surface(first_.get(), layout_.first, picture);
        copy_surface(still_.get(), layout_.second, picture);
    }
    const int width = layout_.second.width, middle = static_cast<int>(plan_.caption_x - 0.5 * type_.gap);
    const auto strip = [&](double from, double to) {
        const int top = static_cast<int>(from),
                  bottom = std::min(static_cast<int>(to), layout_.second.height);
        return Rectangle{0, top, width, std::max(0, bottom - top)};
    };
    Rectangle clock_part = strip(0, plan_.clock_end), caption_part = strip(plan_.caption, plan_.caption_end);
    if (plan_.caption_beside) {
        clock_part.width = caption_part.x = middle;
        caption_part.width = width - middle;
    }
    const std::string clock = clock_words(scene_, frame), caption = playback_text(frame, playback);
    if (!written_ || clock != clock_)
        renew(picture, clock_part, [&](cairo_t* on) {
            clock_block({on, type_, palette_}, scene_, frame, plan_.x, plan_.clock);
        });
    if (!written_ || caption != caption_)
        renew(picture, caption_part, [&](cairo_t* on) {
            const Writer writer{on, type_, palette_};
            if (!caption.empty())
                writer.write(plan_.caption_x, plan_.caption, caption, writer.minor(), palette_.faint_ink,
                             plan_.caption_wrap, plan_.caption_lines);
        });
    const std::string note = note_text(scene_, frame);
    if (plan_.note_end > plan_.note && (!written_ || note != note_))
        renew(picture, strip(plan_.note, plan_.note_end), [&](cairo_t* on) {
            note_block({on, type_, palette_}, note, plan_.x, plan_.note + 0.5 * type_.gap, plan_.inner);
        });
    // The hand is drawn where the drive is; before the drive there is none.
    const double angle = frame.time < 0 ? -1 : frame.phase;
    const double stroke = frame.floor_offset.dot(scene_.drive.direction);
    if (scene_.drive.present && plan_.has_dial && (!written_ || angle != angle_ || stroke != stroke_))
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

void Overlay::lay_over(Picture& picture) const {
    if (!layout_.plates) return;
    for (const Rectangle& plate : first_plates_) lay_part(first_.get(), plate, layout_.first, picture);
    for (const Rectangle& plate : second_plates_) lay_part(second_.get(), plate, layout_.second, picture);
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
