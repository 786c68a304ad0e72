// Arrows of forces at points of a body, and of mean forces on walls.
#include "render/picture/marks/force_marks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/measure/measures.hpp"
#include "engine/scene/bed.hpp"
#include "engine/state/container_faces.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr double longest = 0.14;         // share of the smaller side of the port
constexpr double shortest = 9;           // pens (mark_pen())
constexpr double thin = 1.6, thick = 3;  // pens, of shafts
// Where a smaller share of an arrow's length is seen, a circle stands for the arrow.
constexpr double along_sight = 0.25;

constexpr double room = 10;  // pens: least distance from a grain's centre to the ends of arrows

// Pixels by which an arrow at a grain's surface is moved outwards.
Pixel moved_outwards(const View& view, const PointForce& force, double pen) {
    if (!force.centre) return Pixel(0, 0);
    const Pixel out = view.project(force.at) - view.project(*force.centre);
    const double reach = (force.at - *force.centre).norm() * view.pixels_per_metre(force.at);
    if (reach >= room * pen || out.norm() < 0.1 * reach) return Pixel(0, 0);
    return (room * pen / reach - 1) * out;
}

std::vector<Pixel> circle(const Pixel& middle, double radius) {
    return circle_corners(middle, radius, 24);
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

namespace {

constexpr double usual_arrow = 0.25, longest_arrow = 0.5;  // shares of the container's width
constexpr double grazing = 0.05;                           // sine of 3 degrees
constexpr double packing = 0.55;  // solid fraction of the bed, from which its height is estimated
constexpr double face_on = 0.7;   // cosine: walls beyond it face the eye, and forces on them point at the eye

// The vector whose components are three columns of the last row; NaN where there is no such row or column.
Vec3 last_vector(const Shot& frame, const std::string& name, const std::string& unit) {
    Vec3 vector = Vec3::Constant(std::nan(""));
    for (int axis = 0; axis < 3; ++axis)
        if (const auto column = frame.measures->find(name + "_" + "xyz"[axis] + "_" + unit))
            vector[axis] =
                frame.measures->values(*column, frame.measure_rows - 1, frame.measure_rows).front();
    return vector;
}

// The force on the wall of a cylinder that stands acts all around it. Its arrow stands half way up the bed,
// at the wall's edge in the picture.
Vec3 beside_bed(const FilmedScene& scene, const Face& wall) {
    return {0, wall.radius, 0.5 * fill_height(scene, packing)};
}

// Whether a cylinder lies on its side, so that its bed lies on its wall.
bool lies_on_side(const Vec3& gravity) {
    return gravity.head<2>().norm() > std::abs(gravity.z());
}

}  // namespace

double wall_force_scale(const FilmedScene& scene) {
    return usual_arrow * extent_of(scene).size().y() / scene.film.shows.wall_forces.scale;
}

// The moment M = r x F leaves the place along F open: r = F x M / F^2 + s F. The wall gives s. A plane has
// one solution. In a cylinder the horizontal distance of r from the axis is R, and the larger of the two
// solutions is taken, where the force presses outwards.
std::optional<Vec3> point_of_action(const Face& wall, const Vec3& force, const Vec3& moment) {
    const bool round = wall.kind == Face::Kind::cylinder;
    const double across = round ? force.head<2>().norm() : force.dot(wall.normal);
    if (!(std::abs(across) >= grazing * force.norm()) || force.isZero(0)) return std::nullopt;
    const Vec3 nearest = force.cross(moment) / force.squaredNorm();
    if (!round) return nearest + (wall.point - nearest).dot(wall.normal) / across * force;
    const Eigen::Vector2d along = force.head<2>() / across, from = nearest.head<2>() - wall.point.head<2>();
    const double middle = from.dot(along);
    const double half_chord2 = wall.radius * wall.radius - (from - middle * along).squaredNorm();
    if (!(half_chord2 >= 0)) return std::nullopt;
    return nearest + (std::sqrt(half_chord2) - middle) / across * force;
}

WallForceMarks::WallForceMarks(const FilmedScene& scene, const Palette& palette)
    : scene_(scene), palette_(palette), pen_(mark_pen(scene.film.height)) {
    const std::vector<Face> faces = faces_of(scene);
    const std::vector<std::string> names = face_names(scene);
    for (std::size_t f = 0; f < faces.size(); ++f) walls_.push_back({faces[f], names.at(f)});
}

void WallForceMarks::draw(const View& view, const Shot& frame, Shapes& on) const {
    if (!frame.measures || frame.measure_rows == 0) return;
    for (const Wall& wall : walls_) draw_wall(wall, view, frame, on);
}

// Draws the arrow of one wall. Moments of the container's faces are about the origin of its body, or about a
// point of the axis where it turns; moments of other faces are about a point of the face.
void WallForceMarks::draw_wall(const Wall& wall, const View& view, const Shot& frame, Shapes& on) const {
    const Vec3 force = last_vector(frame, wall.name + "_force", "N");
    const Vec3 moment = last_vector(frame, wall.name + "_moment", "N.m");
    if (!force.allFinite() || !moment.allFinite()) return;
    Face face = wall.face;
    const bool round = face.kind == Face::Kind::cylinder;
    if (round && face.body.number == kTrayBody) return;  // the bed is not beside the tray's wall
    const BodyPose pose = frame.body(static_cast<std::size_t>(face.body.number));
    face.normal = pose.rotation * face.normal;
    if (!round && std::abs(face.normal.dot(view.forward)) > face_on) return;
    Vec3 origin(0, 0, 0);
    if (face.body.number >= kFirstPlaneBody) origin = face.point;
    if (face.body.turn) origin = face.body.turn->through;
    origin = pose.moved(origin);
    face.point = pose.moved(face.point) - origin;
    const bool around = round && !lies_on_side(scene_.gravity);
    const std::optional<Vec3> acts =
        around ? std::optional(beside_bed(scene_, wall.face)) : point_of_action(face, force, moment);
    if (!acts) return;
    const double most = longest_arrow * extent_of(scene_).size().y();
    Vec3 along = wall_force_scale(scene_) * force;
    if (along.norm() > most) along *= most / along.norm();
    const Vec3 tip = (around ? pose.place : origin) + *acts;
    draw_arrow(on, view.project(tip - along), view.project(tip),
               {palette_.wall_force, palette_.background, 2.4 * pen_, pen_});
}

}  // namespace grainreel
