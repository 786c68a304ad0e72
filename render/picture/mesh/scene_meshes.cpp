#include "render/picture/mesh/scene_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/measure/walls/mesh_wear.hpp"

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

SceneMeshes::SceneMeshes(const FilmedScene& scene)
    : by_pressure_(scene.film.look.walls.colour == FilmWalls::Colour::pressure) {
    if (shows_wear(scene)) scale_.emplace(scene.film.look.walls);
    const double edge_angle = scene.film.look.walls.edge_angle * std::numbers::pi / 180;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        if (!mesh.surface) continue;
        drawn_.push_back({mesh_shape(*mesh.surface, edge_angle, look_of(scene, mesh)), {}, nullptr});
        body_.push_back(static_cast<std::size_t>(first_mesh_body(scene)) + m);
        mesh_.push_back(m);
    }
    colours_.resize(drawn_.size());
}

void SceneMeshes::colour_by(const Frame& frame) {
    constexpr std::array<float, 3> as_walls_look{-1, -1, -1};
    if (!scale_) return;
    for (std::size_t m = 0; m < drawn_.size(); ++m) {
        drawn_[m].colours = nullptr;
        if (!frame.worn || mesh_[m] >= frame.worn->size()) continue;
        const MeshWear& worn = (*frame.worn)[mesh_[m]];
        const std::vector<double>& values = by_pressure_ ? worn.pressure : worn.wear;
        if (values.size() != drawn_[m].shape->triangles.size()) continue;
        colours_[m].clear();
        for (const double value : values) {
            colours_[m].push_back(std::isnan(value) ? as_walls_look : bytes(scale_->at(value)));
            clipped_.take(value, {scale_->low(), scale_->high()});
        }
        drawn_[m].colours = &colours_[m];
    }
}

const std::vector<DrawnMesh>& SceneMeshes::at(const Frame& frame) {
    for (std::size_t m = 0; m < drawn_.size(); ++m) drawn_[m].pose = frame.body(body_[m]);
    return drawn_;
}

// Walls are light on a light background. On a dark one they are lighter than the background.
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
