// Puts the blocks of the first gutter (blocks.hpp) below each other at the side, or in rows above the
// container.
#include "render/picture/words/blocks.hpp"

#include <algorithm>

#include "render/picture/camera/framing.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double endless_room = 1e9;  // pixels

// Puts blocks below each other while there is room.
class Column {
  public:
    Column(double x, double y, double room, FirstPart& part)
        : box_{x, y, 0, 0}, y_(y), room_(room), part_(part) {}
    // Adds block(writer, x, y), or leaves it out when it does not fit. `block` is first called with a writer
    // that only measures.
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
        part_.blocks.push_back({name, {box_.x, y, size.width, size.height}});
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

// The blocks of the first gutter. The three layouts below put them in different orders.
class Blocks {
  public:
    Blocks(const FilmedScene& scene, const View* view, double scale)
        : scene_(scene), view_(view), scale_(scale) {}
    auto title(double wrap) const {
        return
            [=, this](const Writer& on, double x, double y) { return title_block(on, scene_, x, y, wrap); };
    }
    auto legend(double wrap, double room) const {
        return [=, this](const Writer& on, double x, double y) {
            return legend_block(on, scene_, x, y, wrap, std::max(room, 1.0));
        };
    }
    auto colour_bar(double width) const {
        return [=, this](const Writer& on, double x, double y) {
            return colour_bar_block(on, scene_, x, y, width);
        };
    }
    auto marks(double wrap) const {
        return [=, this](const Writer& on, double x, double y) {
            return marks_block(on, scene_, scale_, x, y, wrap);
        };
    }
    auto scale_bar(double longest) const {
        return [=, this](const Writer& on, double x, double y) {
            return scene_.film.word_kinds.scale ? scale_block(on, scale_, x, y, longest) : TextSize();
        };
    }
    auto axes() const {
        return [this](const Writer& on, double x, double y) { return axes_block(on, scene_, view_, x, y); };
    }
    auto arrows() const {
        return [this](const Writer& on, double x, double y) { return arrows_block(on, scene_, view_, x, y); };
    }
    const FilmedScene& scene() const { return scene_; }

  private:
    const FilmedScene& scene_;
    const View* view_;
    const double scale_;
};

// Adds a legend with as many species as there is room for. Where some species are missing, a part of the
// legend counts as left out.
void add_legend(Column& column, const Writer& writer, const Blocks& blocks, double gap, double wrap,
                double room, FirstPart& part) {
    if (!blocks.scene().film.word_kinds.legend) return;
    const double left = room - column.end() - gap;
    column.add(writer, "legend", gap, blocks.legend(wrap, left));
    const std::size_t shown = species_in_legend(writer, blocks.scene(), wrap, std::max(left, 1.0));
    if (shown == 0)
        part.left_out.emplace_back("legend");
    else if (shown < blocks.scene().species.size())
        part.left_out.emplace_back("a part of the legend");
}

// The layout above an upright picture, in three rows: the title; the legend beside scale and axes; the colour
// bar beside the marks. If there is not enough room, the axes are left out first.
FirstPart upright_part(const Writer& writer, const Blocks& blocks, double inner, double room) {
    const TypeScale& type = writer.type;
    const Writer measure{nullptr, type, writer.palette};
    const FilmedScene& scene = blocks.scene();
    const bool has_aside = scene.film.word_kinds.scale || scene.film.axes;
    const double x = type.margin, aside = has_aside ? 0.24 * inner : 0;
    const bool both = has_colour_bar(scene.film) && blocks.marks(inner)(measure, 0, 0).height > 0;
    const double half = both ? 0.5 * (inner - 2 * type.gap) : inner;
    const auto colours = blocks.colour_bar(half);
    const auto marks = blocks.marks(half);
    const auto axes = blocks.axes();
    FirstPart part;
    Column top(x, type.margin, room, part);
    top.add(writer, "title", 0, blocks.title(inner));
    const double second = top.end() + (top.end() > type.margin ? 1.2 * type.gap : 0);
    const double last = std::max(colours(measure, 0, 0).height, marks(measure, 0, 0).height);
    Column left(x, second, room, part), right(x + inner - aside, second + 0.4 * type.gap, room, part);
    add_legend(left, writer, blocks, 0, inner - aside - type.gap, room - last, part);
    right.add(writer, "scale bar", 0, blocks.scale_bar(aside));
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

// The layout above a wide picture: title, legend, colour bar, marks, axes and scale beside each other.
FirstPart row_part(const Writer& writer, const Blocks& blocks, double inner, double room) {
    const TypeScale& type = writer.type;
    const Writer measure{nullptr, type, writer.palette};
    const double gap = 2 * type.gap, top = 0.6 * type.margin, third = 0.2 * inner;
    const double bar = blocks.scene().film.word_kinds.scale ? 0.12 * inner : 0,
                 axes = blocks.axes()(measure, 0, 0).width;
    const double colours = blocks.colour_bar(third)(measure, 0, 0).height > 0 ? third : 0;
    const double marks = blocks.marks(third)(measure, 0, 0).height > 0 ? third : 0;
    const double most_title = 0.3 * inner;
    const double words = blocks.title(0)(measure, 0, 0).width;
    const double title = words > 0 ? std::min(most_title, words + 1) : 0;
    FirstPart part;
    double x = type.margin, bottom = top;
    const auto put = [&](const char* name, double width, const auto& block, double down = 0) {
        if (width <= 0) return;
        Column column(x, top + down, room, part);
        column.add(writer, name, 0, block);
        bottom = std::max(bottom, column.end());
        x += width + gap;
    };
    put("title", title, blocks.title(most_title));
    const double others =
        (colours > 0 ? colours + gap : 0) + (marks > 0 ? marks + gap : 0) + (axes > 0 ? axes + gap : 0) + bar;
    const double legend = type.margin + inner - others - gap - x;
    constexpr double least_legend = 0.75;  // of its width without breaks of lines
    if (legend < least_legend * legend_block(measure, blocks.scene(), 0, 0, 0).width)
        part.left_out.emplace_back("a part of the legend");
    Column column(x, top, room, part);
    add_legend(column, writer, blocks, 0, std::max(1.0, legend), room, part);
    bottom = std::max(bottom, column.end());
    x = type.margin + inner - others;
    put("colour bar", colours, blocks.colour_bar(third));
    put("marks", marks, blocks.marks(third));
    put("axes", axes, blocks.axes());
    put("scale bar", bar, blocks.scale_bar(bar), 0.4 * type.gap);
    part.height = bottom;
    part.boxes = {{type.margin, top, inner, bottom - top}};
    return part;
}

// The layout at the left: words about what is seen stand at the upper end, and directions and lengths stand
// at the lower end. has_arrows: whether the directions of gravity and drive belong here.
FirstPart column_part(const Writer& writer, const Blocks& blocks, double inner, double room,
                      bool has_arrows) {
    const TypeScale& type = writer.type;
    const Writer measure{nullptr, type, writer.palette};
    const double x = type.margin;
    const auto length = blocks.scale_bar(0.8 * inner);
    const auto arrows = [&](const Writer& on, double left, double top) {
        return has_arrows ? blocks.arrows()(on, left, top) : TextSize();
    };
    const auto axes = blocks.axes();
    const auto height = [&](const auto& block) { return block(measure, 0, 0).height; };
    const auto with_gap = [&](double high) { return high > 0 ? high + type.gap : 0; };
    double below = height(length) + with_gap(height(arrows));
    FirstPart part;
    Column upper(x, type.margin, room - below, part);
    upper.add(writer, "title", 0, blocks.title(inner));
    // The meaning of the colours is more important than the last species of the legend.
    const double after = with_gap(height(blocks.colour_bar(inner))) + with_gap(height(blocks.marks(inner)));
    const double least = upper.end() + 1.2 * type.gap + 5 * type.main;
    add_legend(upper, writer, blocks, 1.2 * type.gap, inner,
               std::min(room - below, std::max(room - below - after, least)), part);
    upper.add(writer, "colour bar", type.gap, blocks.colour_bar(inner));
    upper.add(writer, "marks", type.gap, blocks.marks(inner));
    const double of_axes = height(arrows) > 0 ? height(axes) : with_gap(height(axes));
    const bool axes_fit = upper.end() + of_axes <= room - below;
    if (axes_fit) below += of_axes;
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

FirstPart first_part(const Writer& writer, const FilmedScene& scene, const View* view,
                     const PictureLayout& layout, double width) {
    const TypeScale& type = writer.type;
    const bool in_rows = layout.one_row || width >= scene.film.width;
    const double inner = std::max(1.0, width - (in_rows ? 2.0 : 1.5) * type.margin);
    const double room = layout.first.height > 0 ? layout.first.height - type.margin : endless_room;
    // The scale holds at the depth of the middle of the framed part.
    const Blocks blocks(scene, view, view ? view->pixels_per_metre(framed_middle(scene)) : 1);
    if (!in_rows) return column_part(writer, blocks, inner, room, !layout.stacked);
    const Writer measure{nullptr, type, writer.palette};
    const bool wide = scene.film.width > 1.2 * scene.film.height;
    if (!wide || !row_part(measure, blocks, inner, room).left_out.empty())
        return upright_part(writer, blocks, inner, room);
    return row_part(writer, blocks, inner, room);
}

}  // namespace grainreel
