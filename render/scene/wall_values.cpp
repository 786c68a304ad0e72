#include "render/scene/wall_values.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/bed.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {
namespace {

// Solid fraction of a bed at rest.
constexpr double packing = 0.6;

// m: of the grains as they lie in the container; without one, of a heap that is as high as it is wide.
double bed_height(const Scene& scene) {
    if (scene.container.shape != Container::Shape::none) return fill_height(scene, packing);
    return std::cbrt(solid_volume(scene) / packing);
}

// Pa, under the bed's weight.
double weight_pressure(const Scene& scene) {
    const double volume = solid_volume(scene);
    if (!(volume > 0)) return 0;
    const double height = std::max(bed_height(scene), mean_diameter(scene));
    return total_mass(scene) / volume * packing * scene.gravity.norm() * height;
}

// m: from the axis of a turn to the farthest place where the mesh may be.
double rim_of(const SceneMesh& mesh, const BodyTurn& turn) {
    double rim = 0;
    for (const Vec3& at : mesh.surface->mesh().vertices)
        rim = std::max(rim, (at - turn.through).cross(turn.axis).norm());
    return rim;
}

// m/s
double top_speed(const Scene& scene, const SceneMesh& mesh) {
    double speed = mesh.velocity.norm();
    if (mesh.turn) speed += std::abs(mesh.turn->rate) * rim_of(mesh, *mesh.turn);
    if (mesh.driven && scene.drive.present) speed += scene.drive.top_speed();
    if (mesh.path) speed += mesh.path->top_speed() + mesh.path->top_spin() * (mesh.high - mesh.low).norm();
    return speed;
}

// m/s, at which grains rub on meshes; where all of these stand, that of grains that fall by their diameter.
double rubbing_speed(const Scene& scene) {
    double speed = 0;
    for (const SceneMesh& mesh : scene.meshes)
        if (mesh.surface) speed = std::max(speed, top_speed(scene, mesh));
    if (speed > 0) return speed;
    return std::sqrt(2 * scene.gravity.norm() * mean_diameter(scene));
}

double wall_friction(const Scene& scene) {
    double most = 0;
    const std::vector<PairContact>& pairs =
        scene.contact.mesh.empty() ? scene.contact.wall : scene.contact.mesh;
    for (const PairContact& pair : pairs)
        most = std::max(most, std::isfinite(pair.friction) ? pair.friction : 1.0);
    return most;
}

}  // namespace

std::array<double, 2> usual_range(FilmWalls::Colour colour, const Scene& scene) {
    const double pressure = weight_pressure(scene);
    if (colour == FilmWalls::Colour::pressure) return {1e-2 * pressure, 10 * pressure};
    constexpr double slip = 0.3;  // of that speed: grains go along with a wall most of the time
    const double wear = slip * wall_friction(scene) * pressure * rubbing_speed(scene) * scene.run.duration;
    return {1e-3 * wear, wear};
}

WallUnit unit_of(const FilmWalls& walls) {
    if (walls.colour == FilmWalls::Colour::pressure) {
        const std::string unit = fitting_unit(walls.range[1], Dimension::pressure);
        return {unit, unit_size(unit, Dimension::pressure)};
    }
    for (const WallUnit& unit : {WallUnit{"kJ/m²", 1e3}, WallUnit{"J/m²", 1}, WallUnit{"mJ/m²", 1e-3}})
        if (walls.range[1] >= 0.5 * unit.size) return unit;
    return {"µJ/m²", 1e-6};
}

}  // namespace grainreel
