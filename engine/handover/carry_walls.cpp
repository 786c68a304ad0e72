// Walls, the frame that the run is in, and the drive.
#include <algorithm>

#include <fmt/format.h>

#include "engine/handover/carry_parts.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

bool is_driven(const Scene& scene) {
    return scene.drive.present && scene.drive.largest_amplitude() > 0;
}

// What keeps the run out of the container's frame: something that does not move with the container. Empty:
// nothing does.
std::string stays_behind(const Scene& scene) {
    if (scene.drive.moves == Drive::Moves::floor) return "the floor alone moves";
    if (scene.container.turn) return "the container turns";
    if (scene.container.outlet) return "grains that have left stay behind";
    if (!scene.exits.empty()) return "exits stand still";
    if (!scene.feeds.empty()) return "the box of a feed stands still";
    for (const FreeWall& wall : scene.walls)
        if (!wall.moves || !wall.velocity.isZero(0)) return "the wall " + wall.name + " moves otherwise";
    for (const SceneMesh& mesh : scene.meshes)
        if (!mesh.driven && mesh.name != scene.container.mesh)
            return "the mesh " + mesh.name + " moves otherwise";
    if (scene.container.shape == Container::Shape::none && scene.walls.empty())
        return "there is no container";
    return {};
}

void check_meshes(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        const std::string where = scene.where(fmt::format("mesh[{}]", m));
        if (carried.engine == PeerEngine::lammps)
            add_refusal(carried, where,
                        fmt::format("mesh {}: LAMMPS of {} has no walls of triangles; use --to liggghts",
                                    mesh.name, version_of(carried.engine)));
        else if (!mesh.path_file.empty())
            add_refusal(carried, where,
                        fmt::format("mesh {}: a motion from a file is not carried; a turn, a steady velocity "
                                    "and the drive are",
                                    mesh.name));
        carried.meshes.push_back({m, m + 1});
    }
}

void check_outlet(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    if (!scene.container.outlet || carried.engine != PeerEngine::lammps) return;
    const std::string where = scene.where("container.outlet");
    if (scene.container.outlet->shape == Outlet::Shape::hole ||
        scene.container.shape == Container::Shape::cylinder)
        add_refusal(
            carried, where,
            "LAMMPS has no region for a floor with a round hole or below a cylinder; use --to liggghts");
    if (scene.container.turn)
        add_refusal(carried, where, "an outlet of a container that turns is not carried");
    if (scene.container.tray)
        add_refusal(carried, scene.where("container.tray"),
                    "a tray is not carried to LAMMPS; use --to liggghts, or leave it out");
}

}  // namespace

void carry_walls(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    carried.faces = faces_of(scene);
    carried.turns.resize(carried.faces.size());
    for (std::size_t f = 0; f < carried.faces.size(); ++f)
        if (carried.faces[f].body.turn) carried.turns[f] = turn_formula(*carried.faces[f].body.turn);
    if (scene.container.outlet) {
        carried.opened = carried.faces;
        open_outlet(scene.container, carried.opened);
    }
    carried.drive = drive_formula(scene.drive);
    carried.periodic = period_of_depth(scene.container) > 0;
    if (is_driven(scene)) {
        const std::string reason = stays_behind(scene);
        carried.frame = reason.empty() ? RunFrame::container : RunFrame::lab;
        if (reason.empty())
            add_change(
                carried, {},
                "the run is in the container's frame: walls stand still, and grains feel minus the "
                "container's acceleration",
                "nothing is lost by it (1e-10 m after half a period), and it is faster than moving walls");
        else if (scene.container.wall_grains)
            add_refusal(
                carried, scene.where("container.wall_grains"),
                fmt::format("glued grains cannot move there, and the run cannot be in the container's "
                            "frame: {}",
                            reason));
    }
    check_meshes(carried);
    check_outlet(carried);
}

}  // namespace grainreel
