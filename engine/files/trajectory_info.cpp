#include "engine/files/trajectory.hpp"

#include "engine/scene/bed.hpp"

namespace grainreel {

TrajectoryInfo trajectory_info(const Scene& scene, const Plan& plan, const std::string& version) {
    TrajectoryInfo info;
    info.title = scene.title;
    info.program_version = version;
    for (const Species& species : scene.species) info.species.push_back(species.name);
    info.capacity = static_cast<std::size_t>(plan.capacity);
    info.traffic = plan.traffic;
    for (const FreeWall& wall : scene.walls) info.bodies.push_back(wall.name);
    for (const SceneMesh& mesh : scene.meshes) {
        info.meshes.push_back({kFirstPlaneBody + info.bodies.size(), mesh.surface->mesh()});
        info.bodies.push_back(mesh.name);
    }
    info.container_turns = scene.container.turn.has_value();
    info.orientation = scene.keeps_orientations();
    info.contact_numbers = true;
    info.cell_origin = extent_of(scene).low;
    if (scene.container.periodic_depth) info.periodic_length.x() = scene.container.depth;
    info.facts = file_facts(scene);
    return info;
}

}  // namespace grainreel
