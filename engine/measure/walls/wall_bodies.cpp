#include "engine/measure/walls/wall_bodies.hpp"

#include <algorithm>

#include "engine/measure/walls/turning.hpp"
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

}  // namespace grainreel
