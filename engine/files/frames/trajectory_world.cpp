#include "engine/files/frames/trajectory_world.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace grainreel {

World world_of(const TrajectoryInfo& info) {
    World world;
    world.title = info.title;
    world.program_version = info.program_version;
    for (std::size_t s = 0; s < info.species.size(); ++s) {
        WorldSpecies& species = world.species.emplace_back();
        species.name = info.species[s];
        if (s < info.facts.densities.size()) species.density = info.facts.densities[s];
    }
    WorldCell& cell = world.cell.emplace();
    cell.origin = info.cell_origin;
    for (int i = 0; i < 3; ++i) {
        const auto edge = static_cast<std::size_t>(i);
        cell.edges[edge][i] = info.periodic_length[i];
        cell.periodic[edge] = info.periodic_length[i] > 0;
    }
    world.bodies = {{"container", {}, {}}, {"floor", {}, {}}};
    for (const std::string& name : info.bodies) world.bodies.push_back({name, {}, {}});
    for (const auto& [body, shape] : info.meshes) world.bodies.at(body).mesh = shape;
    world.container_turns = info.container_turns;
    world.most_grains = info.capacity;
    world.traffic = info.traffic;
    world.facts = info.facts;
    return world;
}

TrajectoryInfo trajectory_info(const World& world, const FrameSupply& supply) {
    TrajectoryInfo info;
    info.title = world.title;
    info.program_version = world.program_version;
    for (const WorldSpecies& species : world.species) info.species.push_back(species.name);
    info.capacity = world.most_grains;
    info.traffic = world.traffic;
    for (std::size_t body = kFirstPlaneBody; body < world.bodies.size(); ++body)
        info.bodies.push_back(world.bodies[body].name);
    for (std::size_t body = 0; body < world.bodies.size(); ++body)
        if (const TriangleMesh& shape = world.bodies[body].mesh; !shape.empty())
            info.meshes.push_back({body, shape});
    info.container_turns = world.container_turns;
    info.orientation = supply.orientations;
    info.contact_numbers = supply.contact_numbers;
    if (world.cell) {
        info.cell_origin = world.cell->origin;
        for (int i = 0; i < 3; ++i) {
            const auto edge = static_cast<std::size_t>(i);
            if (world.cell->periodic[edge]) info.periodic_length[i] = world.cell->edges[edge].norm();
        }
    }
    info.facts = world.facts;
    const bool known =
        std::all_of(world.species.begin(), world.species.end(),
                    [](const WorldSpecies& species) { return std::isfinite(species.density); });
    if (info.facts.densities.empty() && known)
        for (const WorldSpecies& species : world.species) info.facts.densities.push_back(species.density);
    return info;
}

std::vector<std::string> faults_of(const TrajectoryReader& trajectory, const std::string& name) {
    std::vector<std::string> faults;
    if (trajectory.cut_off())
        faults.push_back(fmt::format(
            "{}: frame {} (the first is 0) is not whole, and is left out; the run was killed while "
            "it wrote that frame, or the copy of the file was cut off",
            name, trajectory.frames()));
    if (trajectory.uncounted() > 0)
        faults.push_back(
            fmt::format("{}: counts {} frames and holds {} more; they are left out. The run goes on, or the "
                        "file's header "
                        "is damaged",
                        name, trajectory.frames(), trajectory.uncounted()));
    return faults;
}

}  // namespace grainreel
