// Draws the cylinder: a glass tube on a plate. The thickness of its wall shows as a cut along the outline
// that the eye sees.
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "render/picture/container/drawing_kit.hpp"

namespace grainreel {
namespace {

constexpr int steps = 96;  // steps of a full circle

Vec3 on_circle(double radius, double angle, double z) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

std::vector<Vec3> arc(double radius, double from, double to, double z) {
    const int count =
        std::max(2, static_cast<int>(std::ceil(steps * std::abs(to - from) / (2 * std::numbers::pi))));
    std::vector<Vec3> points;
    for (int i = 0; i <= count; ++i) points.push_back(on_circle(radius, from + (to - from) * i / count, z));
    return points;
}

std::vector<Vec3> circle(double radius, double z) {
    std::vector<Vec3> points = arc(radius, 0, 2 * std::numbers::pi, z);
    points.pop_back();
    return points;
}

// Two angles about z, in rad. The first is the direction of the eye. The second says how far the eye sees the
// tube to each side of that direction: up to where lines of sight touch it (cos = R / distance).
std::pair<double, double> visible_part(double radius, const Sketch& sketch) {
    const Vec3 to_eye = sketch.to_eye();
    const double distance = std::hypot(to_eye.x(), to_eye.y());
    return {std::atan2(to_eye.y(), to_eye.x()), sketch.view().orthographic
                                                    ? 0.5 * std::numbers::pi
                                                    : std::acos(std::min(1.0, radius / distance))};
}

class Cylinder {
  public:
    Cylinder(const Container& container, const Sketches& sketches, ContainerShapes& shapes)
        : radius_(container.half_width),
          height_(container.height),
          thickness_(drawn_thickness(container)),
          lid_(container.lid),
          outlet_(container.outlet),
          turns_(container.turn.has_value()),
          sketches_(sketches),
          shapes_(shapes) {
        std::tie(facing_, half_visible_) = visible_part(radius_, sketches.walls);
    }

    void draw() {
        if (lid_) plate(sketches_.walls, height_, height_ + thickness_, 1);
        plate(sketches_.floor, -1.4 * thickness_, 0, -1);
        glass();
        for (const double side : {-1.0, 1.0}) cut(side);
        if (!lid_) rim();
        if (turns_) ticks();
    }

  private:
    // Draws a disc with a rim. It is in front of the grains while the eye is on its outer side.
    void plate(const Sketch& sketch, double low, double high, double up) {
        const double inner = up > 0 ? low : high, outer = up > 0 ? high : low;
        const double solid = sketch.solid({0, 0, inner}, {0, 0, up});
        const bool behind = !sketch.faces({0, 0, inner}, {0, 0, up});
        WallSide& on = behind ? shapes_.behind : shapes_.before;
        const double wide = radius_ + thickness_;
        const Paint edge = blend(sketch.glass_edge(), sketch.edge(), solid);
        if (solid > 0 && behind) {
            fill(on, sketch, wide, inner, up, faded(sketch.inner_face(), solid), solid);
            sketch.line(on, circle(radius_, inner), true, 0.6 * sketch.pen, faded(sketch.far_edge(), solid));
        }
        const auto upper = arc(wide, facing_ - half_visible_, facing_ + half_visible_, high);
        const auto lower = arc(wide, facing_ - half_visible_, facing_ + half_visible_, low);
        for (std::size_t i = 0; i + 1 < upper.size(); ++i)
            sketch.polygon(on, {upper[i], upper[i + 1], lower[i + 1], lower[i]},
                           blend(sketch.glass_cut(), sketch.cut(), solid));
        // A solid disc seen from outside hides the far half of its inner rim.
        if (solid > 0.5 && !behind)
            sketch.line(on, up > 0 ? lower : upper, false, sketch.pen, edge);
        else
            sketch.line(on, circle(wide, inner), true, sketch.pen, edge);
        if (sketch.faces({0, 0, outer}, {0, 0, up})) {
            fill(on, sketch, wide, outer, up, blend(sketch.glass_face(), sketch.outer_face(), solid));
            sketch.line(on, circle(wide, outer), true, sketch.pen, edge);
        } else {
            sketch.line(on, up > 0 ? upper : lower, false, sketch.pen, edge);
        }
        sketch.line(on, {upper.front(), lower.front()}, false, sketch.pen, edge);
        sketch.line(on, {upper.back(), lower.back()}, false, sketch.pen, edge);
    }

    // Fills a disc. The floor's disc has a hole where its outlet is open.
    void fill(WallSide& on, const Sketch& sketch, double wide, double height, double up, const Paint& paint,
              double taken = 0) const {
        const auto piece_of_disc = [&](const std::vector<Vec3>& piece) {
            if (taken <= 0) return sketch.polygon(on, piece, paint);
            sketch.inner_polygon(on, piece, paint, {0, 0, -up}, taken,
                                 up > 0 ? InnerWall::lid : InnerWall::floor);
        };
        if (up > 0 || !outlet_) return piece_of_disc(circle(wide, height));
        for (const std::vector<Vec3>& piece : disc_around_hole(*outlet_, wide, height)) piece_of_disc(piece);
        sketch.line(on, rim_of_hole(*outlet_, height), true, 0.6 * sketch.pen,
                    faded(sketch.far_edge(), paint.alpha));
    }

    // Draws the far half of the tube. Its tint is stronger where it turns away from the eye.
    void glass() {
        const Sketch& walls = sketches_.walls;
        const double from = facing_ + half_visible_, to = facing_ + 2 * std::numbers::pi - half_visible_;
        const auto low = arc(radius_, from, to, 0), high = arc(radius_, from, to, height_);
        for (std::size_t i = 0; i + 1 < low.size(); ++i) {
            const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(low.size() - 1);
            const double turned = std::abs(2 * middle - 1);
            const Vec3 outward = (0.5 * (low[i] + low[i + 1])).cwiseProduct(Vec3(1, 1, 0)).normalized();
            walls.inner_polygon(shapes_.behind, {low[i], low[i + 1], high[i + 1], high[i]},
                                {walls.palette.solid, 0.06 + 0.24 * turned * turned * turned}, -outward, 1,
                                InnerWall::side);
        }
    }

    // Draws the thickness of the wall along the outline.
    void cut(double side) {
        const Sketch& walls = sketches_.walls;
        const double angle = facing_ + side * half_visible_, wide = radius_ + thickness_;
        const std::vector<Vec3> section = {on_circle(radius_, angle, 0), on_circle(radius_, angle, height_),
                                           on_circle(wide, angle, height_), on_circle(wide, angle, 0)};
        walls.polygon(shapes_.behind, section, walls.is_clear() ? walls.glass_cut() : walls.cut());
        walls.line(shapes_.behind, section, true, walls.pen, walls.edge());
    }

    // Draws the two thin rings of an open top, with their near halves over the grains.
    void rim() {
        const Sketch& walls = sketches_.walls;
        for (const double radius : {radius_, radius_ + thickness_}) {
            const double a = facing_ - half_visible_, b = facing_ + half_visible_;
            walls.line(shapes_.behind, arc(radius, b, a + 2 * std::numbers::pi, height_), false,
                       0.6 * walls.pen, walls.far_edge());
            walls.line(shapes_.before, arc(radius, a, b, height_), false, 0.6 * walls.pen,
                       walls.glass_edge());
        }
    }

    // Draws marks around both rims, which show how the cylinder turns. One of them is long.
    void ticks() {
        constexpr int kTicks = 12;
        const Sketch& walls = sketches_.walls;
        for (const double z : {0.0, height_}) {
            const Vec3 outward(0, 0, z > 0 ? 1 : -1);
            WallSide& on = walls.faces({0, 0, z}, outward) ? shapes_.before : shapes_.behind;
            for (int k = 0; k < kTicks; ++k) {
                const double angle = 2 * std::numbers::pi * k / kTicks, end = radius_ + thickness_;
                const double begin = k == 0 ? radius_ - 2 * thickness_ : radius_;
                walls.line(on, {on_circle(begin, angle, z), on_circle(end, angle, z)}, false, walls.pen,
                           walls.glass_edge());
            }
        }
    }

    const double radius_, height_, thickness_;
    const bool lid_;
    const std::optional<Outlet> outlet_;
    const bool turns_;
    const Sketches& sketches_;
    ContainerShapes& shapes_;
    double facing_ = 0, half_visible_ = 0;  // rad, about z
};

}  // namespace

std::vector<Vec3> cylinder_corners(const Container& container, double top) {
    const double t = drawn_thickness(container);
    std::vector<Vec3> corners;
    for (const double z : {-1.4 * t, std::min(top, container.height + (container.lid ? t : 0))})
        for (const Vec3& point : circle(container.half_width + t, z)) corners.push_back(point);
    return corners;
}

void draw_cylinder_ghost(const Container& container, bool floor_only, const Sketch& lab, Shapes& on) {
    const double t = drawn_thickness(container), wide = container.half_width + t;
    const auto [facing, half] = visible_part(container.half_width, lab);
    const double top = floor_only ? 0 : container.height + (container.lid ? t : 0);
    std::vector<Vec3> outline = arc(wide, facing - half, facing + half, -1.4 * t);
    const std::vector<Vec3> upper = arc(wide, facing + half, facing - half, top);
    outline.insert(outline.end(), upper.begin(), upper.end());
    lab.dashed(on, outline, true, 0.8 * lab.pen, lab.ghost());
}

void draw_cylinder(const Container& container, const Sketches& sketches, ContainerShapes& shapes) {
    Cylinder(container, sketches, shapes).draw();
}

}  // namespace grainreel
