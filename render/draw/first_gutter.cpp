#include "render/draw/first_gutter.hpp"

#include <algorithm>

#include "render/draw/framing.hpp"
#include "render/draw/writer.hpp"

namespace grainreel {
namespace {

constexpr double endless_room = 1e9;  // pixels

// Blocks that are put below each other while there is room.
class Column {
  public:
    Column(double x, double y, double room, FirstPart& part)
        : box_{x, y, 0, 0}, y_(y), room_(room), part_(part) {}
    // block(writer, x, y), with a writer that measures first. Left out whole when it does not fit.
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
    const double scale = view ? view->pixels_per_metre(framed_middle(scene)) : 1;
    return (layout.portrait ? portrait_part : landscape_part)(writer, scene, view, scale, inner, room);
}

}  // namespace grainreel
