#include "render/picture/container/lab_marks.hpp"

#include <cmath>
#include <numbers>

#include "engine/scene/drive_schedule.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// How far the container's floor reaches to the side that a camera at this azimuth has at its right; m.
double reach_aside(const Container& container, double half, double azimuth) {
    if (container.shape == Container::Shape::cylinder) return half;
    return half * std::abs(std::cos(azimuth)) + 0.5 * container.depth * std::abs(std::sin(azimuth));
}

}  // namespace

Vec3 drawn_stroke(const FilmedScene& scene) {
    if (!scene.drive.present) return {0, 0, 0};
    return scene.film.exaggerate * drive_peaks(scene.drive).offset * scene.drive.direction;
}

bool has_lab_marks(const FilmedScene& scene) {
    return scene.film.word_kinds.arrows && scene.drive.present && scene.drive.largest_amplitude() > 0 &&
           scene.container.shape != Container::Shape::none && scene.film.camera.up == Vec3(0, 0, 1);
}

std::vector<LabMark> lab_marks(const FilmedScene& scene, double azimuth) {
    if (!has_lab_marks(scene)) return {};
    const Container& container = scene.container;
    const double thickness = drawn_thickness(container), floor_half = outer_floor_half_width(container);
    // In the plane of the near cross-section; across the line of sight beside a cylinder, or where the camera
    // moves and near and far change places.
    azimuth *= std::numbers::pi / 180;
    const bool across = container.shape == Container::Shape::cylinder || scene.film.camera.moves();
    const double eye_side = std::cos(azimuth) >= 0 ? 1 : -1;
    // A vessel's marks stand at its lowest place; other floors rest at 0.
    const double base = container.shape == Container::Shape::mesh ? container.base() : 0;
    const Vec3 middle = across ? Vec3(0, 0, base) : Vec3(eye_side * 0.5 * container.depth, 0, base);
    const Vec3 side = across ? Vec3(-std::sin(azimuth), std::cos(azimuth), 0) : Vec3(0, 1, 0);
    const Vec3 stroke = drawn_stroke(scene);
    const double half = across ? reach_aside(container, floor_half, azimuth) : floor_half;
    if (std::abs(scene.drive.direction.z()) >= 0.5)
        return {{middle - (half + thickness) * side, -2.2 * thickness * side, stroke},
                {middle + (half + thickness) * side, 2.2 * thickness * side, stroke}};
    return {{middle - Vec3(0, 0, 2 * thickness), {0, 0, -2.2 * thickness}, stroke}};
}

void draw_lab_marks(const FilmedScene& scene, const Sketches& sketches, double azimuth, WallSide& on) {
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

}  // namespace grainreel
