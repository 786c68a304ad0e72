#include "render/picture/marks/point_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/picture/marks/arrow.hpp"

namespace grainreel {
namespace {

constexpr double longest = 0.14;         // over the smaller side of the bed's part of the picture
constexpr double shortest = 9;           // pens
constexpr double thin = 1.6, thick = 3;  // pens, of shafts
constexpr double along_sight = 0.25;     // of the length in space that is seen, below which it is a circle

constexpr double room = 10;  // pens, from a grain's centre to the ends of arrows at the least

// Pixels by which what points at a grain's surface is moved outwards.
Pixel moved_outwards(const View& view, const PointForce& force, double pen) {
    if (!force.centre) return Pixel(0, 0);
    const Pixel out = view.project(force.at) - view.project(*force.centre);
    const double reach = (force.at - *force.centre).norm() * view.pixels_per_metre(force.at);
    if (reach >= room * pen || out.norm() < 0.1 * reach) return Pixel(0, 0);
    return (room * pen / reach - 1) * out;
}

std::vector<Pixel> circle(const Pixel& middle, double radius) {
    constexpr int corners = 24;
    std::vector<Pixel> ring;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners;
        ring.push_back(middle + radius * Pixel(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

void draw_along_sight(const ForceArrow& arrow, const Pixel& middle, const Palette& palette, double pen,
                      Shapes& on) {
    const double radius = pen * (4 + 4 * arrow.share), width = 1.4 * pen;
    on.polygon(circle(middle, radius + 1.5 * pen), {palette.background, 1});
    on.line(circle(middle, radius), true, width, {palette.force, 1});
    if (arrow.at_eye) {
        on.polygon(circle(middle, 0.35 * radius), {palette.force, 1});
        return;
    }
    const double arm = radius / std::numbers::sqrt2;
    for (const double side : {-1.0, 1.0})
        on.line({middle - arm * Pixel(1, side), middle + arm * Pixel(1, side)}, false, width,
                {palette.force, 1});
}

}  // namespace

double longest_force_arrow(const View& view) {
    return longest * std::min(view.port.width, view.port.height);
}

std::vector<ForceArrow> force_arrows(const View& view, const std::vector<PointForce>& forces, double pen) {
    double strongest = 0;
    for (const PointForce& one : forces) strongest = std::max(strongest, one.force.norm());
    std::vector<ForceArrow> arrows;
    for (const PointForce& one : forces) {
        const double force = one.force.norm();
        if (!(force > 0)) continue;
        const double share = force / strongest;
        const double pixels = std::max(shortest * pen, share * longest_force_arrow(view));
        const Vec3 way = pixels / view.pixels_per_metre(one.at) / force * one.force;
        const Vec3 tail = one.pulls ? one.at : Vec3(one.at - way);
        const Vec3 tip = tail + way;
        const Pixel aside = moved_outwards(view, one, pen);
        arrows.push_back({view.project(tail) + aside, view.project(tip) + aside, share,
                          one.force.dot(view.forward) < 0, pixels});
    }
    return arrows;
}

void draw_point_forces(const View& view, const std::vector<PointForce>& forces, const Palette& palette,
                       double pen, Shapes& on) {
    std::vector<ForceArrow> arrows = force_arrows(view, forces, pen);
    std::stable_sort(arrows.begin(), arrows.end(),
                     [](const ForceArrow& a, const ForceArrow& b) { return a.share > b.share; });
    for (const ForceArrow& arrow : arrows) {
        if ((arrow.tip - arrow.tail).norm() < along_sight * arrow.in_space)
            draw_along_sight(arrow, 0.5 * (arrow.tail + arrow.tip), palette, pen, on);
        else
            draw_arrow(on, arrow.tail, arrow.tip,
                       {palette.force, palette.background, pen * (thin + (thick - thin) * arrow.share), pen});
    }
}

}  // namespace grainreel
