// Planes of the scene's own: the piece of each that lies in the box of what is looked at.
#include <cmath>

#include "render/draw/drawing_kit.hpp"

namespace grainreel {
namespace {

// Corners of the plane's cut through the box, in order around it; fewer than three when it misses.
std::vector<Vec3> cut(const FreeWall& wall, const Vec3& point, const Extent& extent) {
    const std::vector<Vec3> corners = extent_corners(extent);
    std::vector<Vec3> crossings;
    for (int a = 0; a < 8; ++a) {
        for (const int axis : {1, 2, 4}) {
            if (a & axis) continue;
            const Vec3 &one = corners[a], &two = corners[a | axis];
            const double before = wall.normal.dot(one - point), after = wall.normal.dot(two - point);
            if (before * after > 0 || before == after) continue;
            crossings.push_back(one + before / (before - after) * (two - one));
        }
    }
    if (crossings.size() < 3) return {};
    Vec3 middle = Vec3::Zero();
    for (const Vec3& c : crossings) middle += c / static_cast<double>(crossings.size());
    const Vec3 u = wall.normal.unitOrthogonal(), v = wall.normal.cross(u);
    std::sort(crossings.begin(), crossings.end(), [&](const Vec3& a, const Vec3& b) {
        return std::atan2(v.dot(a - middle), u.dot(a - middle)) <
               std::atan2(v.dot(b - middle), u.dot(b - middle));
    });
    return crossings;
}

}  // namespace

std::vector<Vec3> extent_corners(const Extent& extent) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back((k & 1 ? extent.high : extent.low).x(), (k & 2 ? extent.high : extent.low).y(),
                             (k & 4 ? extent.high : extent.low).z());
    return corners;
}

void draw_free_wall(const FreeWall& wall, const Extent& extent, const Sketch& sketch,
                    ContainerShapes& shapes) {
    // The sketch moves what it draws, so the cut is made where the wall is and taken back.
    std::vector<Vec3> piece = cut(wall, wall.point + sketch.offset(), extent);
    if (piece.size() < 3) return;
    for (Vec3& corner : piece) corner -= sketch.offset();
    Shapes& on = sketch.faces(wall.point, wall.normal) ? shapes.behind : shapes.before;
    // Solid where the eye is on the grains' side.
    const double solid = sketch.solid(wall.point, -wall.normal);
    sketch.polygon(on, piece, blend(sketch.glass_face(), sketch.inner_face(), solid));
    sketch.line(on, piece, true, sketch.pen, blend(sketch.glass_edge(), sketch.far_edge(), solid));
}

void draw_free_wall_ghost(const FreeWall& wall, const Extent& extent, const Sketch& lab, Shapes& on) {
    const std::vector<Vec3> piece = cut(wall, wall.point, extent);
    if (piece.size() >= 3) lab.dashed(on, piece, true, 0.8 * lab.pen, lab.ghost());
}

}  // namespace grainreel
