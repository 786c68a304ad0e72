#include "render/draw/container_drawing.hpp"

#include <cmath>
#include <numbers>

#include "render/draw/camera_path.hpp"
#include "render/draw/drawing_kit.hpp"

namespace grainreel {
namespace {

// m, from rest to the end of the stroke, as drawn.
Vec3 drawn_stroke(const Scene& scene) {
    if (!scene.drive.present) return {0, 0, 0};
    return scene.film.exaggerate * scene.drive.amplitude * scene.drive.direction;
}

// A scale fixed in the lab beside the floor: a long tick where the floor rests and short ones at both ends of
// its stroke, and a pointer that goes with the floor.
struct LabMark {
    Vec3 foot;    // m, where the long tick begins, at rest
    Vec3 along;   // m, its direction and length
    Vec3 stroke;  // m, the displacement at the end of the stroke
};

// How far the container's floor reaches to the side that a camera at this azimuth has at its right; m.
double reach_aside(const Container& container, double half, double azimuth) {
    if (container.shape == Container::Shape::cylinder) return half;
    return half * std::abs(std::cos(azimuth)) + 0.5 * container.depth * std::abs(std::sin(azimuth));
}

// azimuth: degrees, of the camera.
std::vector<LabMark> lab_marks(const Scene& scene, double azimuth) {
    if (!scene.drive.present || scene.drive.amplitude <= 0) return {};
    if (scene.container.shape == Container::Shape::none) return {};
    const Container& container = scene.container;
    const double thickness = drawn_thickness(container), floor_half = outer_floor_half_width(container);
    // In the plane of the near cross-section; across the line of sight beside a cylinder, or where the camera
    // moves and near and far change places.
    azimuth *= std::numbers::pi / 180;
    const bool across = container.shape == Container::Shape::cylinder || scene.film.camera.moves();
    const double eye_side = std::cos(azimuth) >= 0 ? 1 : -1;
    const Vec3 middle = across ? Vec3(0, 0, 0) : Vec3(eye_side * 0.5 * container.depth, 0, 0);
    const Vec3 side = across ? Vec3(-std::sin(azimuth), std::cos(azimuth), 0) : Vec3(0, 1, 0);
    const Vec3 stroke = drawn_stroke(scene);
    const double half = across ? reach_aside(container, floor_half, azimuth) : floor_half;
    if (std::abs(scene.drive.direction.z()) >= 0.5)
        return {{middle - (half + thickness) * side, -2.2 * thickness * side, stroke},
                {middle + (half + thickness) * side, 2.2 * thickness * side, stroke}};
    return {{middle - Vec3(0, 0, 2 * thickness), {0, 0, -2.2 * thickness}, stroke}};
}

// degrees, also of a camera that looks straight down
double azimuth_of(const View& view) {
    return std::atan2(-view.right.x(), view.right.y()) * 180 / std::numbers::pi;
}

void draw_lab_marks(const Scene& scene, const Sketches& sketches, double azimuth, WallSide& on) {
    const double pen = sketches.lab.pen;
    const Paint ink{sketches.lab.palette.faint_ink, 1}, accent{sketches.lab.palette.accent, 1};
    const double thickness = drawn_thickness(scene.container);
    const bool floor_only = scene.drive.moves == Drive::Moves::floor;
    const Sketch& moving = floor_only ? sketches.floor : sketches.walls;
    for (const LabMark& mark : lab_marks(scene, azimuth)) {
        const Vec3 unit = mark.along.normalized();
        const Vec3 from = mark.foot, to = mark.foot + mark.along;
        sketches.lab.line(on, {from, to}, false, 0.8 * pen, ink);
        for (const double end : {-1.0, 1.0})
            sketches.lab.line(on, {from + end * mark.stroke, from + 0.45 * mark.along + end * mark.stroke},
                              false, 0.8 * pen, ink);
        sketches.lab.line(on, {from - mark.stroke, from + mark.stroke}, false, 0.8 * pen, ink);
        const Vec3 side = 0.35 * thickness * mark.stroke.normalized();
        const Vec3 back = mark.foot - 0.9 * thickness * unit;
        moving.polygon(on, {back - side, back + side, mark.foot}, accent);
    }
}

}  // namespace

double drawn_thickness(const Container& container) {
    return 0.018 * (2 * container.half_width + container.height);
}

namespace {

std::vector<Vec3> corners_of(const Scene& scene) {
    switch (scene.container.shape) {
        case Container::Shape::cylinder:
            return cylinder_corners(scene.container);
        case Container::Shape::none:
            return extent_corners(extent_of(scene));
        case Container::Shape::wedge:
        case Container::Shape::box:
            break;
    }
    return prism_corners(scene.container);
}

void draw_ghost(const Scene& scene, const Sketch& lab, Shapes& on) {
    for (const FreeWall& wall : scene.walls)
        if (wall.moves) draw_free_wall_ghost(wall, scene, lab, on);
    const bool floor_only = scene.drive.moves == Drive::Moves::floor;
    if (scene.container.shape == Container::Shape::cylinder)
        draw_cylinder_ghost(scene.container, floor_only, lab, on);
    else if (scene.container.shape != Container::Shape::none)
        draw_prism_ghost(scene.container, floor_only, lab, on);
}

// m, above the rim of an open top, for grains in flight: a grain that meets the rising bed leaves it at up to
// twice the walls' speed. At most half the container, or the bed would look small.
double room_above(const Scene& scene) {
    const Container& container = scene.container;
    const double gravity = scene.gravity.norm();
    if (container.shape == Container::Shape::none || container.lid || !scene.drive.present || gravity <= 0)
        return 0;
    const double thrown = 2 * scene.drive.speed() * std::abs(scene.drive.direction.z());
    const double highest = fill_height(scene, 0.55) + thrown * thrown / (2 * gravity);
    return std::clamp(highest - container.height, 0.0, 0.5 * container.height);
}

}  // namespace

std::vector<Vec3> framing_points(const Scene& scene, double azimuth) {
    std::vector<Vec3> corners = corners_of(scene);
    if (const double room = room_above(scene); room > 0)
        corners.emplace_back(0, 0, scene.container.height + room);
    std::vector<Vec3> points;
    const Vec3 stroke = drawn_stroke(scene);
    for (const double end : {-1.0, 1.0}) {
        for (const Vec3& corner : corners) points.push_back(corner + end * stroke);
        for (const LabMark& mark : lab_marks(scene, azimuth))
            for (const Vec3& point : {mark.foot, Vec3(mark.foot + mark.along)})
                points.push_back(point + end * stroke);
    }
    return points;
}

std::vector<Vec3> framing_points(const Scene& scene) {
    return framing_points(scene, scene.film.camera.azimuth);
}

View frame_container(const Scene& scene, const PictureLayout& layout) {
    return CameraPath(scene, layout).at(0);
}

void draw_container(const Scene& scene, const Views& views, const Frame& frame, const Palette& palette,
                    int picture_height, ContainerShapes& shapes) {
    shapes.behind.clear();
    shapes.before.clear();
    shapes.over.clear();
    const Sketches sketches{{views, palette, picture_height, frame.wall_offset},
                            {views, palette, picture_height, frame.floor_offset},
                            {views, palette, picture_height, Vec3(0, 0, 0)}};
    if (scene.container.shape == Container::Shape::cylinder)
        draw_cylinder(scene.container, sketches, shapes);
    else if (scene.container.shape != Container::Shape::none)
        draw_prism(scene.container, sketches, shapes);
    for (const FreeWall& wall : scene.walls) {  // inside, so over the container's far walls
        const Vec3 offset = (wall.moves ? frame.floor_offset : Vec3(0, 0, 0)) + frame.time * wall.velocity;
        draw_free_wall(wall, scene, {views, palette, picture_height, offset}, shapes);
    }
    draw_lab_marks(scene, sketches, azimuth_of(views.at_rest), shapes.behind);
    if (scene.film.wall_ghost) draw_ghost(scene, sketches.lab, shapes.over);
}

}  // namespace grainreel
