#include "engine/files/file_facts.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/triangle_mesh.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

std::string vector_text(const Vec3& v) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x(), v.y(), v.z());
}

std::string turn_text(const BodyTurn& turn) {
    return fmt::format("at {:.9g} rad s-1 about the axis {} through {} m{}", turn.rate,
                       vector_text(turn.axis), vector_text(turn.through),
                       turn.from > 0 || turn.over > 0 || std::isfinite(turn.until)
                           ? "; it begins or ends smoothly, see scene.toml"
                           : "");
}

std::string motion_text(const SceneMesh& mesh) {
    if (mesh.turn) return "turns " + turn_text(*mesh.turn);
    if (!mesh.path_file.empty()) return "moves by a file (" + mesh.path_hash + ")";
    if (!mesh.velocity.isZero(0)) return "moves at " + vector_text(mesh.velocity) + " m s-1";
    return mesh.driven ? "moves with the drive" : "at rest";
}

std::string container_text(const Container& c) {
    std::string text;
    switch (c.shape) {
        case Container::Shape::none:
            return "none: empty space";
        case Container::Shape::mesh:
            text =
                fmt::format("the mesh {}, room of {:.9g} m (x), {:.9g} m (y), from {:.9g} m to {:.9g} m (z)",
                            c.mesh, c.depth, 2 * c.half_width, c.base(), c.height);
            break;
        case Container::Shape::cylinder:
            text = fmt::format("cylinder, {:.9g} m in diameter, {:.9g} m high", 2 * c.half_width, c.height);
            break;
        case Container::Shape::box:
            text = fmt::format("box, {:.9g} m wide (y), {:.9g} m deep (x), {:.9g} m high (z)",
                               2 * c.half_width, c.depth, c.height);
            break;
        case Container::Shape::wedge:
            text = fmt::format(
                "wedge, {:.9g} m wide (y) above its slants and {:.9g} m at its floor, slants {:.9g} m high, "
                "{:.9g} "
                "m deep (x), {:.9g} m high (z)",
                2 * c.half_width, 2 * c.floor_half_width(), c.slant_height, c.depth, c.height);
    }
    text += c.lid ? ", with a lid" : ", open above";
    if (c.periodic_depth) text += ", periodic along x";
    if (c.outlet) text += ", with an outlet in the floor";
    if (c.tray) text += " and a tray below it";
    if (c.turn) text += ", which turns " + turn_text(*c.turn);
    return text;
}

std::string drive_text(const Drive& drive) {
    if (!drive.present) return "none";
    const Vec3& along = drive.direction;
    return fmt::format(
        "at first {:.9g} Hz, amplitude {:.9g} m, along ({:.6g}, {:.6g}, {:.6g}), moves the {}{}",
        drive.frequency, drive.amplitude, along.x(), along.y(), along.z(),
        drive.moves == Drive::Moves::container ? "container" : "floor alone",
        drive.changes() ? "; it changes later, see scene.toml" : "");
}

std::string frame_text(const Scene& scene, bool seen_from_container) {
    const std::string axes =
        scene.container.shape == Container::Shape::none
            ? "x, y, z as in the scene"
            : "x along the depth, y across, z up, from the middle of the container's floor at rest";
    if (seen_from_container && scene.drive.moves == Drive::Moves::container)
        return "the container: " + axes + ", wherever the drive has it; velocities are against the container";
    return "the room: " + axes + "; walls and floor move in it";
}

}  // namespace

FileFacts file_facts(const Scene& scene, bool seen_from_container) {
    FileFacts facts;
    const Vec3& g = scene.gravity;
    facts.attributes = {{"gravity", fmt::format("({:.9g}, {:.9g}, {:.9g}) m s-2", g.x(), g.y(), g.z())},
                        {"container", container_text(scene.container)},
                        {"drive", drive_text(scene.drive)},
                        {"seed", fmt::format("{}", scene.run.seed)},
                        {"frame_of_reference", frame_text(scene, seen_from_container)}};
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        facts.attributes.emplace_back(
            fmt::format("mesh_{}", m + 1),
            fmt::format("{}: {} triangles, file of hash {}, {}", mesh.name, mesh.shape().triangles.size(),
                        mesh.hash, motion_text(mesh)));
    }
    for (const Species& species : scene.species) facts.densities.push_back(species.density);
    std::vector<std::string> walls;
    for (const std::string& name : face_names(scene))
        walls.push_back(fmt::format("{} {}", -1 - static_cast<int>(walls.size()), name));
    facts.walls = fmt::format("{}", fmt::join(walls, ", "));
    return facts;
}

}  // namespace grainreel
