#include "engine/step/surroundings.hpp"

#include <algorithm>

#include "engine/plan/plan.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

constexpr double kSkinShare = 0.4;  // as a share of the smallest radius

double smallest_radius(const Scene& scene) {
    double smallest = scene.species[0].diameter.smallest;
    for (const Species& s : scene.species) smallest = std::min(smallest, s.diameter.smallest);
    return 0.5 * smallest;
}

std::vector<MeshWall> mesh_walls(const Scene& scene) {
    std::vector<MeshWall> walls;
    if (scene.meshes.empty()) return walls;
    const std::vector<Body> bodies = bodies_of(scene);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        const Body& body = bodies[static_cast<std::size_t>(first_mesh_body(scene)) + m];
        walls.push_back({mesh.name, mesh.surface.of, body, mesh.turn ? mesh.turn->through : mesh.position});
    }
    return walls;
}

// Adds the exits of a box. If grains inside the box leave, it is one exit; if those outside it leave, there
// is one exit beyond each of its sides.
void add_exits(const ExitBox& box, std::vector<Exit>& exits) {
    Exit inside;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 along = Vec3::Unit(axis);
        inside.sides.push_back({along, box.high[axis]});
        inside.sides.push_back({-along, -box.low[axis]});
        if (!box.outside) continue;
        exits.push_back({{{along, box.low[axis]}}});
        exits.push_back({{{-along, -box.high[axis]}}});
    }
    if (!box.outside) exits.push_back(inside);
}

}  // namespace

Surroundings make_surroundings(const Scene& scene, const Plan& plan) {
    Surroundings around;
    around.faces = faces_of(scene);
    around.glued = glue_grains(scene, around.faces);
    around.motion = DriveMotion(scene.drive, plan.clock);
    around.gravity = scene.gravity;
    around.period = period_of_depth(scene.container);
    around.skin = kSkinShare * smallest_radius(scene);
    around.meshes = mesh_walls(scene);
    for (const ExitBox& box : scene.exits) add_exits(box, around.exits);
    return around;
}

void open_outlet(const Scene& scene, Surroundings& around) {
    open_outlet(scene.container, around.faces);
    if (!scene.container.tray) around.exits.push_back(exit_below(-scene.container.outlet->exit_depth));
}

}  // namespace grainreel
