#include "engine/files/frames/world.hpp"

#include <memory>

#include "engine/scene/bed.hpp"

namespace grainreel {

World world_of(const Scene& scene) {
    World world;
    world.title = scene.title;
    for (const Species& species : scene.species)
        world.species.push_back({species.name, species.diameter.mean, species.density, species.count});
    WorldCell& cell = world.cell.emplace();
    const Extent extent = extent_of(scene);
    world.low = extent.low;
    world.high = extent.high;
    cell.origin = extent.low;
    if (scene.container.periodic_depth) {
        cell.edges[0].x() = scene.container.depth;
        cell.periodic[0] = true;
    }
    world.bodies = {{"container", {}, {}}, {"floor", {}, {}}};
    for (const FreeWall& wall : scene.walls) world.bodies.push_back({wall.name, {}, {}});
    for (const SceneMesh& mesh : scene.meshes) world.bodies.push_back({mesh.name, {}, mesh.surface->mesh()});
    world.container_turns = scene.container.turn.has_value();
    for (const Face& face : faces_of(scene))
        if (face.body.number >= 0)
            world.bodies.at(static_cast<std::size_t>(face.body.number)).faces.push_back(face);
    world.most_grains = static_cast<std::size_t>(scene.grains());
    world.facts = file_facts(scene);
    return world;
}

namespace {

// The meshes of a world, at rest. Bodies are numbered with the planes before the meshes, and of planes
// nothing is known but where they are; with some of them a scene cannot number the meshes.
std::vector<SceneMesh> meshes_of(const World& world) {
    std::vector<SceneMesh> meshes;
    for (std::size_t body = kFirstPlaneBody; body < world.bodies.size(); ++body) {
        const WorldBody& one = world.bodies[body];
        if (one.mesh.empty()) return {};
        SceneMesh& mesh = meshes.emplace_back();
        mesh.name = one.name;
        MeshFacts facts;
        facts.triangles = facts.read = static_cast<std::int64_t>(one.mesh.triangles.size());
        facts.vertices = static_cast<std::int64_t>(one.mesh.vertices.size());
        mesh.surface.of = std::make_shared<const Surface>(one.mesh, facts, one.name);
    }
    return meshes;
}

}  // namespace

Scene scene_of(const World& world) {
    Scene scene;
    scene.title = world.title;
    scene.container.shape = Container::Shape::none;
    scene.meshes = meshes_of(world);
    for (const WorldSpecies& one : world.species) {
        Species species;
        species.name = one.name;
        species.count = one.count;
        species.diameter.mean = one.diameter;
        species.density = one.density;
        scene.species.push_back(species);
    }
    return scene;
}

}  // namespace grainreel
