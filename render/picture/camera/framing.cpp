// Which points the automatic framing takes into the picture: of container, meshes, streams, sources and
// marks.
#include "render/picture/camera/framing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/plan/reach.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// As a share of the container's height. If the picture should reach higher, the whole container is shown.
constexpr double almost_all = 0.88;
constexpr double steepest = 60;  // degrees; looking down or up more steeply, the camera shows all of it

double upward(const FilmedScene& scene) {
    return std::abs(scene.drive.direction.z());
}

// m: room above the rim of an open top for grains in flight. A grain that meets the rising bed leaves it at
// up to twice the walls' speed. The room is at most half the container's height, or the bed would look small.
double room_above(const FilmedScene& scene) {
    const Container& container = scene.container;
    const double gravity = scene.gravity.norm();
    if (container.shape == Container::Shape::none || container.lid || !scene.drive.present || gravity <= 0)
        return 0;
    const double thrown = 2 * drive_peaks(scene.drive).speed * upward(scene);
    const double highest = fill_height(scene, 0.55) + thrown * thrown / (2 * gravity);
    return std::clamp(highest - container.height, 0.0, 0.5 * container.height);
}

bool looks_steeply(const Camera& camera) {
    if (std::abs(camera.elevation) > steepest) return true;
    return std::any_of(camera.keys.begin(), camera.keys.end(), [](const CameraKey& key) {
        return key.elevation && std::abs(*key.elevation) > steepest;
    });
}

// m above the floor's rest position: how high the picture should reach, counting the motion as it is drawn.
std::optional<double> wanted_top(const FilmedScene& scene) {
    const Camera& camera = scene.film.camera;
    const double stroke = scene.drive.present ? drive_peaks(scene.drive).offset * upward(scene) : 0;
    if (camera.frame == FramingScope::bed) {
        const std::optional<double> rest = resting_top(scene);
        return rest ? std::optional(*rest + scene.film.exaggerate * stroke) : std::nullopt;
    }
    std::optional<double> top = camera.reach ? camera.reach : estimated_reach(scene);
    if (top) *top += (scene.film.exaggerate - 1) * stroke + (camera.follow ? stroke : 0);
    return top;
}

// The corners of a container that turns, at many angles around its axis.
std::vector<Vec3> turned(const std::vector<Vec3>& corners, const BodyTurn& turn) {
    constexpr int kTurns = 24;
    std::vector<Vec3> all;
    for (int k = 0; k < kTurns; ++k) {
        const Eigen::AngleAxisd by(2 * std::numbers::pi * k / kTurns, turn.axis);
        for (const Vec3& corner : corners) all.push_back(turn.through + by * (corner - turn.through));
    }
    return all;
}

std::vector<Vec3> corners_at_rest(const FilmedScene& scene, const FramedPart& part,
                                  const std::vector<Vec3>& meshes) {
    const double top = part.cut ? part.top : 1e300;
    switch (scene.container.shape) {
        case Container::Shape::cylinder:
            return cylinder_corners(scene.container, top);
        case Container::Shape::mesh:
            return {};
        case Container::Shape::none:
            return meshes.empty() ? extent_corners(extent_of(scene)) : std::vector<Vec3>();
        case Container::Shape::wedge:
        case Container::Shape::box:
            break;
    }
    return prism_corners(scene.container, top);
}

std::vector<Vec3> corners_of(const FilmedScene& scene, const FramedPart& part,
                             const std::vector<Vec3>& meshes) {
    std::vector<Vec3> corners = corners_at_rest(scene, part, meshes);
    if (scene.container.turn) corners = turned(corners, *scene.container.turn);
    for (const Vec3& point : meshes)
        if (!part.cut || point.z() <= part.top) corners.push_back(point);
    return corners;
}

std::vector<Vec3> tray_corners(const FilmedScene& scene) {
    const Container tray = tray_container(scene);
    const bool round = tray.shape == Container::Shape::cylinder;
    std::vector<Vec3> corners = round ? cylinder_corners(tray, 1e300) : prism_corners(tray, 1e300);
    for (Vec3& corner : corners) corner.z() -= scene.container.tray->depth;
    return corners;
}

// Adds the stream below an outlet, down to where grains leave the run.
void add_stream(const Container& container, std::vector<Vec3>& corners) {
    const Outlet& outlet = *container.outlet;
    const double y = outlet.half_width, x = outlet.shape == Outlet::Shape::slot ? 0.5 * container.depth : y;
    for (const double side : {-1.0, 1.0})
        for (const double end : {-1.0, 1.0}) corners.emplace_back(end * x, side * y, -outlet.exit_depth);
}

// Adds the boxes that grains come from, unless they lie far above everything else.
void add_sources(const FilmedScene& scene, std::vector<Vec3>& corners) {
    const bool framed =
        scene.container.shape == Container::Shape::none || scene.container.shape == Container::Shape::mesh;
    if (!framed || corners.empty()) return;
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(),
                                                 [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    const double top = high->z(), most = top + 0.5 * (top - low->z());
    const auto add = [&](const Vec3& from, const Vec3& to) {
        if (to.z() > most && from.z() > top) return;
        for (const Vec3& corner : extent_corners({from, to})) corners.push_back(corner);
    };
    for (const Feed& feed : scene.feeds) add(feed.low, feed.high);
    if (scene.start.region) add(scene.start.region->low, scene.start.region->high);
}

// Adds the place where grains leave below all meshes, unless it is far away.
void add_fall(const FilmedScene& scene, std::vector<Vec3>& corners) {
    const std::optional<double> end = exit_level(scene);
    if (!end || corners.empty()) return;
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(),
                                                 [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    if (*end >= low->z() || low->z() - *end > 0.5 * (high->z() - low->z())) return;
    const Vec3 middle = extent_of(scene).middle();
    corners.emplace_back(middle.x(), middle.y(), *end);
}

}  // namespace

FramedPart whole_container(const FilmedScene& scene) {
    return {scene.container.height + room_above(scene), false};
}

FramedPart framed_part(const FilmedScene& scene) {
    const Container& container = scene.container;
    const bool all = scene.film.camera.frame == FramingScope::container ||
                     container.shape == Container::Shape::none || container.shape == Container::Shape::mesh ||
                     container.turn || looks_steeply(scene.film.camera) ||
                     scene.film.camera.up != Vec3(0, 0, 1);
    const std::optional<double> top = all ? std::nullopt : wanted_top(scene);
    if (!top) return whole_container(scene);
    const double height = container.height;
    if (*top <= almost_all * height) return {std::max(*top, drawn_thickness(container)), true};
    return {container.lid ? height : std::clamp(*top, height, 1.5 * height), false};
}

Vec3 framed_middle(const FilmedScene& scene) {
    Extent extent = extent_of(scene);
    const FramedPart part = framed_part(scene);
    if (part.cut) extent.high.z() = part.top;
    return extent.middle();
}

std::vector<Vec3> framing_points(const FilmedScene& scene, double azimuth, const FramedPart& part,
                                 const std::vector<Vec3>& meshes, const Vec3& stroke) {
    std::vector<Vec3> corners = corners_of(scene, part, meshes);
    if (scene.container.tray)
        for (const Vec3& corner : tray_corners(scene)) corners.push_back(corner);
    else if (scene.container.outlet)
        add_stream(scene.container, corners);
    if (!meshes.empty()) {
        add_fall(scene, corners);
        add_sources(scene, corners);
    }
    if (!part.cut && part.top > scene.container.height) corners.emplace_back(0, 0, part.top);
    const std::vector<LabMark> marks = lab_marks(scene, azimuth);
    std::vector<Vec3> points;
    for (const double end : {-1.0, 1.0}) {
        for (const Vec3& corner : corners) {
            // Where the container is cut off by the picture, its stroke upwards is not seen.
            const bool at_top = part.cut && corner.z() >= part.top;
            points.push_back(corner + end * Vec3(stroke.x(), stroke.y(), at_top ? 0 : stroke.z()));
        }
        for (const LabMark& mark : marks)
            for (const Vec3& point : {mark.foot, Vec3(mark.foot + mark.along)})
                points.push_back(point + end * stroke);
    }
    return points;
}

std::vector<Vec3> framing_points(const FilmedScene& scene, double azimuth, const FramedPart& part,
                                 const std::vector<Vec3>& meshes) {
    return framing_points(scene, azimuth, part, meshes, drawn_stroke(scene));
}

std::vector<Vec3> framing_points(const FilmedScene& scene, double azimuth) {
    return framing_points(scene, azimuth, framed_part(scene), mesh_reach(scene));
}

std::vector<Vec3> framing_points(const FilmedScene& scene) {
    return framing_points(scene, scene.film.camera.azimuth);
}

}  // namespace grainreel
