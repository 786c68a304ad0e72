// What the drawings of containers share: paints and dashes of sketches, side walls, floors with a hole, and
// the ruler that stands still beside the container.
#include "render/picture/container/drawing_kit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/drive_schedule.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// Sine of 8 degrees. While the camera moves or the container turns, a part changes from glass to solid over
// twice this angle, and the far end becomes the near one over twice this angle.
const double fade = std::sin(8 * std::numbers::pi / 180);

}  // namespace

double smooth_rise(double value, double half_width) {
    const double s = std::clamp(0.5 + 0.5 * value / half_width, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

Paint faded(const Paint& paint, double share) {
    return {paint.colour, paint.alpha * share};
}

Paint blend(const Paint& one, const Paint& other, double share_of_other) {
    if (share_of_other <= 0) return one;
    if (share_of_other >= 1) return other;
    const double a = one.alpha * (1 - share_of_other), b = other.alpha * share_of_other;
    return {mix(one.colour, other.colour, b / std::max(a + b, 1e-9)), a + b};
}

double Sketch::solid(const Vec3& point, const Vec3& normal) const {
    // The change is shifted by `fade`, so that a part is wholly glass when the eye comes into its plane.
    // There it moves from the layer behind the grains to the layer in front of them.
    if (views_.clear) return 0;
    const View& view = views_.at_rest;
    if (turned_) {
        const Vec3 at = views_.now.orthographic ? Vec3(-views_.now.forward)
                                                : Vec3((views_.now.eye - moved(point)).normalized());
        return smooth_rise(-turned(normal).dot(at) - fade, fade);
    }
    if (!views_.moves) return view.faces(point, normal) ? 0 : 1;
    const Vec3 to_eye = view.orthographic ? Vec3(-view.forward) : Vec3(view.eye - point).normalized();
    return smooth_rise(-normal.dot(to_eye) - fade, fade);
}

double Sketch::positive_end_is_near() const {
    const double towards = -view().forward.dot(turned(Vec3(1, 0, 0)));
    return views_.moves || turned_ ? smooth_rise(towards, fade) : towards >= 0 ? 1 : 0;
}

void Sketch::dashed(Shapes& on, std::vector<Vec3> points, bool closed, double width,
                    const Paint& paint) const {
    if (closed) points.push_back(points.front());
    const std::vector<Pixel> path = project(points);
    const double dash = 7 * pen, gap = 5 * pen;
    double walked = 0;  // pixels since a dash began
    std::vector<Pixel> piece{path.front()};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double length = (path[i + 1] - path[i]).norm();
        for (double done = 0; done < length;) {
            const bool drawing = walked < dash;
            const double step = std::min((drawing ? dash : dash + gap) - walked, length - done);
            done += step;
            walked += step;
            const Pixel here = path[i] + done / length * (path[i + 1] - path[i]);
            if (drawing) piece.push_back(here);
            if (drawing && walked >= dash) on.line(piece, false, width, paint);
            if (walked >= dash + gap - 1e-9) {
                walked = 0;
                piece = {here};
            }
        }
    }
    if (walked < dash) on.line(piece, false, width, paint);
}

WallProfile wall_profile(const Container& container, double side) {
    const double t = drawn_thickness(container), top = container.height;
    WallProfile profile;
    const auto add = [&](double inner, double z, double outer, double outer_z) {
        profile.inner.emplace_back(side * inner, z);
        profile.outer.emplace_back(side * outer, outer_z);
    };
    const double angle = container.shape == Container::Shape::wedge ? container.half_angle : 0;
    const double bend = angle > 0 ? std::min(container.slant_height, top) : 0;
    if (bend > 0) add(container.half_width_at(0), 0, container.half_width_at(0) + t / std::cos(angle), 0);
    if (bend > 0 && bend < top)
        add(container.half_width, bend, container.half_width + t, bend - t * std::tan(0.5 * angle));
    if (bend <= 0) add(container.half_width, 0, container.half_width + t, 0);
    const double slant = bend >= top ? t / std::cos(angle) : t;
    add(container.half_width_at(top), top, container.half_width_at(top) + slant, top);
    return profile;
}

namespace {

constexpr int kSteps = 96;  // steps of a full circle
constexpr double kTurn = 2 * std::numbers::pi;

std::vector<double> even_angles() {
    std::vector<double> angles;
    for (int i = 0; i < kSteps; ++i) angles.push_back(kTurn * i / kSteps);
    return angles;
}

Vec3 at(double radius, double angle, double height) {
    return {radius * std::cos(angle), radius * std::sin(angle), height};
}

// reach(angle): m, from the middle of the hole to the floor's outer edge.
template <class Reach>
Pieces around_hole(const Outlet& outlet, const std::vector<double>& angles, double height,
                   const Reach& reach) {
    Pieces pieces;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double a = angles[i], b = angles[(i + 1) % angles.size()];
        const double hole = outlet.half_width;
        pieces.push_back(
            {at(hole, a, height), at(hole, b, height), at(reach(b), b, height), at(reach(a), a, height)});
    }
    return pieces;
}

}  // namespace

Container container_at(const Container& container, double time) {
    Container now = container;
    if (now.outlet && time < now.outlet->opens) now.outlet.reset();
    return now;
}

std::vector<Vec3> rim_of_hole(const Outlet& outlet, double height) {
    std::vector<Vec3> points;
    for (const double angle : even_angles()) points.push_back(at(outlet.half_width, angle, height));
    return points;
}

Pieces disc_around_hole(const Outlet& outlet, double radius, double height) {
    return around_hole(outlet, even_angles(), height, [radius](double) { return radius; });
}

Pieces rectangle_around_hole(const Outlet& outlet, double half_depth, double half_width, double height) {
    std::vector<double> angles = even_angles();
    const double corner = std::atan2(half_width, half_depth);
    for (const double angle : {corner, kTurn / 2 - corner, kTurn / 2 + corner, kTurn - corner})
        angles.push_back(angle);
    std::sort(angles.begin(), angles.end());
    return around_hole(outlet, angles, height, [&](double angle) {
        return std::min(half_depth / std::max(std::abs(std::cos(angle)), 1e-12),
                        half_width / std::max(std::abs(std::sin(angle)), 1e-12));
    });
}

namespace {

// Half the width (m) of the floor in the picture, for a camera at this azimuth (rad). half: m, along y.
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
    // The marks stand in the plane of the container's end that is nearer to the camera. For a cylinder, and
    // for a camera that moves, they stand in the plane through the middle that is perpendicular to the line
    // of sight.
    azimuth *= std::numbers::pi / 180;
    const bool across = container.shape == Container::Shape::cylinder || scene.film.camera.moves();
    const double eye_side = std::cos(azimuth) >= 0 ? 1 : -1;
    // A container made of a mesh has its marks at its lowest place. All other floors are at z = 0 at rest.
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
