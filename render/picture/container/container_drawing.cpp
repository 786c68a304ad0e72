// Draws the container as a whole: which part goes in front of or behind the grains, free walls, and the fade
// of grains that leave. The shapes of cylinder and prism are in draw_cylinder.cpp and draw_prism.cpp.
#include "render/picture/container/container_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/scene/bed.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// degrees: the camera's azimuth, also where it looks straight down.
double azimuth_of(const View& view) {
    return std::atan2(-view.right.x(), view.right.y()) * 180 / std::numbers::pi;
}

}  // namespace

double drawn_thickness(const Container& container) {
    return 0.018 * (2 * container.half_width + container.height);
}

namespace {

void draw_ghost(const FilmedScene& scene, const Sketch& lab, Shapes& on) {
    for (const ScenePlane& wall : scene.walls)
        if (wall.moves) draw_free_wall_ghost(wall, scene, lab, on);
    const bool floor_only = scene.drive.moves == Drive::Moves::floor;
    if (scene.container.shape == Container::Shape::cylinder)
        draw_cylinder_ghost(scene.container, floor_only, lab, on);
    else if (is_prism(scene.container))
        draw_prism_ghost(scene.container, floor_only, lab, on);
}

void draw_at(const Container& container, const Sketches& sketches, ContainerShapes& shapes) {
    if (container.shape == Container::Shape::cylinder)
        draw_cylinder(container, sketches, shapes);
    else if (is_prism(container))
        draw_prism(container, sketches, shapes);
}

}  // namespace

void draw_container(const FilmedScene& scene, const Views& views, const State& frame, const Palette& palette,
                    int picture_height, ContainerShapes& shapes) {
    shapes.behind.clear();
    shapes.before.clear();
    shapes.over.clear();
    const Sketches sketches{{views, palette, picture_height, frame.container()},
                            {views, palette, picture_height, frame.floor()},
                            {views, palette, picture_height, BodyPose()}};
    if (scene.container.tray) {
        BodyPose place;
        place.place.z() = -scene.container.tray->depth;
        const Sketch below{views, palette, picture_height, place};
        draw_at(tray_container(scene), {below, below, below}, shapes);
    }
    shapes.behind.container = 1;
    draw_at(container_at(scene.container, frame.time), sketches, shapes);
    // Free walls are inside the container, so they are painted over its far walls.
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        ++shapes.behind.container;
        const BodyPose pose = frame.body(kFirstPlaneBody + w);
        draw_free_wall(scene.walls[w], scene, {views, palette, picture_height, pose}, shapes);
    }
    draw_lab_marks(scene, sketches, azimuth_of(views.at_rest), shapes.behind);
    if (scene.film.wall_ghost) draw_ghost(scene, sketches.lab, shapes.over);
}

// Free walls are planes. Of each plane the piece inside the container is drawn; without a container, the
// piece inside the box of everything that the camera looks at.

namespace {

// The corners of the plane's cut through the box, in order around it; fewer than three where the plane misses
// the box.
std::vector<Vec3> cut(const ScenePlane& wall, const Vec3& point, const Extent& extent) {
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

// The part of a convex piece where normal . (p - point) >= 0 (Sutherland and Hodgman 1974).
std::vector<Vec3> clipped(const std::vector<Vec3>& piece, const Vec3& point, const Vec3& normal) {
    std::vector<Vec3> left;
    for (std::size_t k = 0; k < piece.size(); ++k) {
        const Vec3 &from = piece[k], &to = piece[(k + 1) % piece.size()];
        const double a = normal.dot(from - point), b = normal.dot(to - point);
        if (a >= 0) left.push_back(from);
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) left.push_back(from + a / (a - b) * (to - from));
    }
    return left;
}

// The part of a piece inside those walls of the container that are not sides of the box.
std::vector<Vec3> inside(std::vector<Vec3> piece, const Container& container) {
    if (container.shape == Container::Shape::wedge && container.half_angle > 0) {
        const double cosine = std::cos(container.half_angle), sine = std::sin(container.half_angle);
        for (const double side : {-1.0, 1.0})
            piece = clipped(piece, {0, side * container.floor_half_width(), 0}, {0, -side * cosine, sine});
    }
    constexpr int kSides = 96;  // sides of the polygon that stands for a circle
    for (int k = 0; container.shape == Container::Shape::cylinder && k < kSides; ++k) {
        const double angle = 2 * std::numbers::pi * k / kSides;
        const Vec3 outward(std::cos(angle), std::sin(angle), 0);
        piece = clipped(piece, container.half_width * outward, -outward);
    }
    return piece;
}

}  // namespace

std::vector<Vec3> piece_of_plane(const ScenePlane& wall, const FilmedScene& scene, const Vec3& offset) {
    std::vector<Vec3> piece = inside(cut(wall, wall.point + offset, extent_of(scene)), scene.container);
    return piece.size() >= 3 ? piece : std::vector<Vec3>();
}

std::vector<Vec3> extent_corners(const Extent& extent) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back((k & 1 ? extent.high : extent.low).x(), (k & 2 ? extent.high : extent.low).y(),
                             (k & 4 ? extent.high : extent.low).z());
    return corners;
}

void draw_free_wall(const ScenePlane& wall, const FilmedScene& scene, const Sketch& sketch,
                    ContainerShapes& shapes) {
    // The sketch moves what it draws. So the piece is cut where the wall is now, and then moved back.
    std::vector<Vec3> piece = piece_of_plane(wall, scene, sketch.offset());
    if (piece.empty()) return;
    for (Vec3& corner : piece) corner -= sketch.offset();
    WallSide& on = sketch.faces(wall.point, wall.normal) ? shapes.behind : shapes.before;
    // The wall is solid where the eye is on the side of the grains.
    const double solid = sketch.solid(wall.point, -wall.normal);
    const bool behind = &on == &shapes.behind;
    sketch.inner_polygon(on, piece, blend(sketch.glass_face(), sketch.inner_face(), solid), wall.normal,
                         behind ? solid : 0, InnerWall::free);
    sketch.line(on, piece, true, sketch.pen, blend(sketch.glass_edge(), sketch.far_edge(), solid));
}

void draw_free_wall_ghost(const ScenePlane& wall, const FilmedScene& scene, const Sketch& lab, Shapes& on) {
    const std::vector<Vec3> piece = piece_of_plane(wall, scene, Vec3(0, 0, 0));
    if (!piece.empty()) lab.dashed(on, piece, true, 0.8 * lab.pen, lab.ghost());
}

namespace {

constexpr double begins_at = 0.5;  // share of the way from the floor to the exit at which the fade begins
constexpr double least_rows = 4;

// Pixels from the top: the lowest point that the floor's plate reaches in the course of the film, as it is
// drawn.
double lowest_of_floor(const FilmedScene& scene, const View& view) {
    const Container& c = scene.container;
    const double thick = 1.4 * drawn_thickness(c);
    const Vec3 stroke = drawn_stroke(scene);
    const double x = (c.shape == Container::Shape::cylinder ? c.half_width : 0.5 * c.depth) + thick,
                 y = c.floor_half_width() + thick;
    double lowest = 0;
    for (const double side : {-1.0, 1.0})
        for (const double end : {-1.0, 1.0})
            for (const double way : {-1.0, 1.0})
                lowest = std::max(lowest, view.project(Vec3(side * x, end * y, -thick) + way * stroke).y());
    return lowest;
}

// Where grains begin to fall and where they leave (m), and the row in which the lowest wall ends.
struct Fall {
    Vec3 from, to;
    double lowest_row;
};

std::optional<Fall> fall_below_outlet(const FilmedScene& scene, const View& view) {
    const Container& c = scene.container;
    if (!c.outlet || c.tray) return std::nullopt;
    return Fall{Vec3(0, 0, 0), Vec3(0, 0, -c.outlet->exit_depth), lowest_of_floor(scene, view)};
}

// The fall of grains that leave below all meshes. Where the drive moves a mesh, the meshes count as far down
// as its stroke reaches.
std::optional<Fall> fall_into_exit(const FilmedScene& scene, const View& view,
                                   const std::vector<Vec3>& meshes) {
    const std::optional<double> end = exit_level(scene);
    if (!end || meshes.empty()) return std::nullopt;
    const bool driven = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                    [](const SceneMesh& mesh) { return mesh.driven; });
    const Vec3 stroke = driven ? drawn_stroke(scene) : Vec3(0, 0, 0);
    double lowest = meshes.front().z(), row = 0;
    for (const Vec3& point : meshes)
        for (const double way : {-1.0, 1.0}) {
            lowest = std::min(lowest, point.z() + way * stroke.z());
            row = std::max(row, view.project(point + way * stroke).y());
        }
    if (*end >= lowest) return std::nullopt;
    const Vec3 middle = extent_of(scene).middle();
    return Fall{{middle.x(), middle.y(), lowest}, {middle.x(), middle.y(), *end}, row};
}

}  // namespace

std::optional<double> exit_level(const FilmedScene& scene) {
    std::optional<double> level;
    for (const ExitBox& box : scene.exits) {
        const double here = box.outside ? box.low.z() : box.high.z();
        level = std::max(level.value_or(here), here);
    }
    return level;
}

std::vector<std::uint32_t> exit_fade(const FilmedScene& scene, const View& view, int height,
                                     const std::vector<Vec3>& meshes) {
    std::optional<Fall> fall = fall_below_outlet(scene, view);
    if (!fall) fall = fall_into_exit(scene, view, meshes);
    if (!fall) return {};
    const double end = view.project(fall->to).y();
    const double half_way = view.project(fall->from + begins_at * (fall->to - fall->from)).y();
    const double begin = std::max(half_way, fall->lowest_row);
    if (!std::isfinite(begin) || !std::isfinite(end) || end - begin < least_rows) return {};
    std::vector<std::uint32_t> rows;
    for (int y = 0; y < height; ++y)
        rows.push_back(static_cast<std::uint32_t>(
            std::lround(255 * std::clamp((end - y - 0.5) / (end - begin), 0.0, 1.0))));
    return rows;
}

}  // namespace grainreel
