#include "engine/questions/snapshot.hpp"

#include <fmt/format.h>

#include "engine/base/numbers.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

bool Snapshot::has(Needs what) const {
    switch (what) {
        case Needs::contacts:
            return contacts;
        case Needs::forces:
            return forces.has_value();
        case Needs::period:
            return !displacement.empty() || frame.size() == 0;
        case Needs::velocities:
            return velocities;
        case Needs::spins:
            return spins;
        case Needs::nothing:
            break;
    }
    return true;
}

double Snapshot::mass(std::size_t i) const {
    return mass_of(frame, i, scene.species.at(static_cast<std::size_t>(frame.species[i])).density);
}

double Snapshot::mean_diameter() const {
    double sum = 0;
    for (const double radius : frame.radius) sum += 2 * radius;
    return sum / static_cast<double>(frame.size());
}

double Snapshot::height(std::size_t i) const {
    return (frame.position[i] - floor_offset(scene, frame)).z();
}

std::optional<std::size_t> Snapshot::place_of(std::int64_t id) const {
    return frame.row_of(id);
}

namespace {

// How far the drive has moved the container. In a container that turns, only a point of the axis moves with
// the drive alone, so its way is taken.
Vec3 offset_of(const Scene& scene, const BodyPose& pose) {
    const std::optional<BodyTurn>& turn = scene.container.turn;
    return turn ? Vec3(pose.moved(turn->through) - turn->through) : pose.place;
}

}  // namespace

Vec3 container_offset(const Scene& scene, const State& frame) {
    return offset_of(scene, frame.container());
}

Vec3 floor_offset(const Scene& scene, const State& frame) {
    return offset_of(scene, frame.floor());
}

std::vector<std::string> wall_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const Face& face : faces_of(scene)) names.push_back(face.name);
    for (const SceneMesh& mesh : scene.meshes) names.push_back(mesh.name);
    return names;
}

std::optional<std::size_t> mesh_of_wall(const Scene& scene, std::int32_t wall) {
    const std::size_t faces = faces_of(scene).size();
    const std::int64_t number = -1 - static_cast<std::int64_t>(wall);
    if (number < static_cast<std::int64_t>(faces)) return std::nullopt;
    const auto mesh = static_cast<std::size_t>(number) - faces;
    return mesh < scene.meshes.size() ? std::optional(mesh) : std::nullopt;
}

std::string name_of_body(const Snapshot& snapshot, std::int32_t id) {
    if (id >= 0) {
        const std::optional<std::size_t> place = snapshot.place_of(id);
        if (!place) return "unknown";
        return snapshot.scene.species.at(static_cast<std::size_t>(snapshot.frame.species[*place])).name;
    }
    const std::vector<std::string> names = wall_names(snapshot.scene);
    const auto wall = static_cast<std::size_t>(-1 - static_cast<std::int64_t>(id));
    return wall < names.size() ? names[wall] : fmt::format("wall {}", wall);
}

std::vector<Vec3> displacement_since(const State& before, const State& now, int periods, double depth) {
    const std::vector<std::size_t> rows = rows_in(before, now);
    std::vector<Vec3> displacement(now.size(), Vec3::Constant(kUnknown));
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (rows[i] == kNoRow) continue;
        Vec3 way = now.position[i] - before.position[rows[i]];
        way.x() = nearest_image(way.x(), depth);
        displacement[i] = way / periods;
    }
    return displacement;
}

}  // namespace grainreel
