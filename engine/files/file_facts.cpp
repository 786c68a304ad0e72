#include "engine/files/file_facts.hpp"

#include <fmt/format.h>

#include "engine/state/face_names.hpp"

namespace grainreel {
namespace {

std::string container_text(const Container& c) {
    std::string text;
    switch (c.shape) {
        case Container::Shape::none:
            return "none: empty space";
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
    for (const Species& species : scene.species) facts.densities.push_back(species.density);
    std::vector<std::string> walls;
    for (const std::string& name : face_names(scene))
        walls.push_back(fmt::format("{} {}", -1 - static_cast<int>(walls.size()), name));
    facts.walls = fmt::format("{}", fmt::join(walls, ", "));
    return facts;
}

}  // namespace grainreel
