#include "render/picture/mesh/scene_meshes.hpp"

#include <algorithm>
#include <numbers>

namespace grainreel {
namespace {

bool names(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

std::array<float, 3> bytes(const Colour& colour) {
    return {static_cast<float>(255 * colour.red), static_cast<float>(255 * colour.green),
            static_cast<float>(255 * colour.blue)};
}

}  // namespace

MeshLook look_of(const FilmedScene& scene, const SceneMesh& mesh) {
    if (names(scene.film.look.walls.solid, mesh.name)) return MeshLook::solid;
    if (names(scene.film.look.walls.glass, mesh.name)) return MeshLook::vessel;
    if (scene.container.shape == Container::Shape::mesh && mesh.name == scene.container.mesh)
        return MeshLook::vessel;
    if (!scene.start.region || scene.container.shape == Container::Shape::mesh) return MeshLook::automatic;
    const Vec3 middle = 0.5 * (scene.start.region->low + scene.start.region->high);
    const EnclosedRoom room(mesh.surface.of);
    return room.encloses_anything() && room.holds(middle) ? MeshLook::vessel : MeshLook::automatic;
}

SceneMeshes::SceneMeshes(const FilmedScene& scene) {
    const double edge_angle = scene.film.look.walls.edge_angle * std::numbers::pi / 180;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        if (!mesh.surface) continue;
        drawn_.push_back({mesh_shape(*mesh.surface, edge_angle, look_of(scene, mesh)), {}, nullptr});
        body_.push_back(static_cast<std::size_t>(first_mesh_body(scene)) + m);
    }
}

const std::vector<DrawnMesh>& SceneMeshes::at(const Frame& frame) {
    for (std::size_t m = 0; m < drawn_.size(); ++m) drawn_[m].pose = frame.body(body_[m]);
    return drawn_;
}

// Light walls on light backgrounds, and on dark ones lighter than these.
MeshPaints mesh_paints(const Palette& palette, const Vec3& up, int picture_height) {
    const bool dark = luminance(palette.background) <= 0.18;
    const auto between = [&](double share) { return bytes(mix(palette.background, palette.solid, share)); };
    return {between(dark ? 0.25 : 0.85), between(dark ? 0.85 : 0.18), bytes(palette.solid), up,
            static_cast<float>(std::max(1.0, picture_height / 600.0))};
}

MeshPainter::Inks mesh_inks(const Palette& palette) {
    return {bytes(palette.solid), bytes(palette.ink)};
}

}  // namespace grainreel
