#include "engine/measure/walls/wall_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

WallBody body_of(const Scene& scene, const Face& face) {
    WallBody wall;
    wall.body = static_cast<std::size_t>(std::max(face.body.number, kContainerBody));
    wall.point = face.point;
    const bool container = face.body.number == kContainerBody || face.body.number == kFloorBody;
    if (!container || !scene.container.turn) return wall;
    wall.fixed = false;
    wall.turns = true;
    wall.point = scene.container.turn->through;
    wall.axis = scene.container.turn->axis;
    return wall;
}

}  // namespace

std::vector<WallBody> wall_bodies(const Scene& scene) {
    std::vector<WallBody> walls;
    for (const Face& face : faces_of(scene)) walls.push_back(body_of(scene, face));
    auto body = static_cast<std::size_t>(first_mesh_body(scene));
    for (const SceneMesh& mesh : scene.meshes) {
        WallBody& wall = walls.emplace_back();
        wall.body = body++;
        wall.mesh = true;
        wall.fixed = !mesh.moves();
        wall.turns = mesh.turn.has_value();
        wall.point = moment_point(mesh);
        if (mesh.turn) wall.axis = mesh.turn->axis;
    }
    return walls;
}

namespace {

double from_axis(const BodyTurn& turn, const Vec3& place) {
    return turn.axis.cross(place - turn.through).norm();
}

// The largest distance of a circle's points from an axis. The circle is level, with its centre on the z axis.
double circle_from_axis(const BodyTurn& turn, double radius, double z) {
    constexpr int kPoints = 720;  // the error of the distance is below 1e-5 of the radius
    double farthest = 0;
    for (int k = 0; k < kPoints; ++k) {
        const double angle = 2 * std::numbers::pi * k / kPoints;
        farthest = std::max(farthest,
                            from_axis(turn, Vec3(radius * math::cos(angle), radius * math::sin(angle), z)));
    }
    return farthest;
}

double container_from_axis(const Container& c, const BodyTurn& turn) {
    double farthest = 0;
    for (const double z : {c.base(), c.height}) {
        if (c.shape == Container::Shape::cylinder) {
            farthest = std::max(farthest, circle_from_axis(turn, c.half_width, z));
            continue;
        }
        for (const double x : {-0.5 * c.depth, 0.5 * c.depth})
            for (const double y : {-c.half_width_at(z), c.half_width_at(z)})
                farthest = std::max(farthest, from_axis(turn, Vec3(x, y, z)));
    }
    if (c.shape == Container::Shape::wedge)
        for (const double x : {-0.5 * c.depth, 0.5 * c.depth})
            for (const double y : {-c.half_width, c.half_width})
                farthest = std::max(farthest, from_axis(turn, Vec3(x, y, c.slant_height)));
    return farthest;
}

}  // namespace

std::optional<std::size_t> vessel_of(const Scene& scene) {
    if (scene.container.shape != Container::Shape::mesh) return std::nullopt;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        if (scene.meshes[m].name == scene.container.mesh) return m;
    return std::nullopt;
}

bool turns_over(const Scene& scene) {
    constexpr double kStands = 1 - 1e-6;  // cosine of the angle to the vertical
    const auto lies = [&](const std::optional<BodyTurn>& turn) {
        return turn && std::abs(turn->axis.normalized().z()) < kStands;
    };
    const std::optional<std::size_t> vessel = vessel_of(scene);
    return lies(scene.container.turn) || (vessel && lies(scene.meshes[*vessel].turn));
}

Vec3 moment_point(const SceneMesh& mesh) {
    return mesh.turn ? mesh.turn->through : mesh.position;
}

std::optional<TurningBody> turning_body(const Scene& scene) {
    const Container& container = scene.container;
    if (container.turn && container.shape != Container::Shape::mesh)
        return TurningBody{kContainerBody, *container.turn, container_from_axis(container, *container.turn)};
    const auto mesh = [&](std::size_t m) {
        const SceneMesh& one = scene.meshes[m];
        return TurningBody{first_mesh_body(scene) + static_cast<std::int32_t>(m), *one.turn,
                           one.surface->farthest_from_axis(one.turn->through, one.turn->axis)};
    };
    if (const auto vessel = vessel_of(scene); vessel && scene.meshes[*vessel].turn) return mesh(*vessel);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        if (scene.meshes[m].turn) return mesh(m);
    return std::nullopt;
}

}  // namespace grainreel
