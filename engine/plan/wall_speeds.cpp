#include "engine/plan/wall_speeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "engine/base/error.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {
namespace {

constexpr double most_of_a_grain = 0.1;  // that a rim moves in one step

double distance_from_axis(const BodyTurn& turn, const Vec3& place) {
    const Vec3 from = place - turn.through;
    return (from - turn.axis.dot(from) * turn.axis).norm();
}

// m: of the container's farthest point. Corners of a box, or the two circles at the ends of a cylinder.
double farthest_from_axis(const Container& c, const BodyTurn& turn) {
    constexpr int places = 90;  // round a circle
    const bool round = c.shape == Container::Shape::cylinder;
    double farthest = 0;
    for (const double z : {0.0, c.height}) {
        for (int k = 0; k < (round ? places : 4); ++k) {
            const double angle = 2 * std::numbers::pi * k / places;
            const Vec3 at = round ? Vec3(c.half_width * std::cos(angle), c.half_width * std::sin(angle), z)
                                  : Vec3((k % 2 - 0.5) * c.depth, (k / 2 * 2 - 1) * c.half_width, z);
            farthest = std::max(farthest, distance_from_axis(turn, at));
        }
    }
    return farthest;
}

double smallest_diameter(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Species& species : scene.species)
        if (species.all() > 0) smallest = std::min(smallest, species.diameter.smallest);
    return smallest;
}

// Refused at the key that makes the wall so fast.
void check_rim(const Scene& scene, const std::string& key, const std::string& name, double speed,
               double step) {
    const double smallest = smallest_diameter(scene), moved = speed * step;
    if (!(moved > most_of_a_grain * smallest)) return;
    throw UserError(fmt::format(
        "{}: {} moves at up to {:.4g} m/s, by {:.3g} m in a step of {:.4g} s, which is {:.2g} of the "
        "smallest "
        "grain, more than {}, so that grains may pass through it; make it at least {:.2g} times slower, or "
        "give a 'run.step' of at most {:.3g} s",
        scene.where(key), name, speed, moved, step, moved / smallest, most_of_a_grain,
        moved / (most_of_a_grain * smallest), most_of_a_grain * smallest / speed));
}

std::string motion_key(const SceneMesh& mesh) {
    return mesh.turn ? ".turn.rate" : mesh.path ? ".path" : ".velocity";
}

}  // namespace

double own_speed(const SceneMesh& mesh) {
    double speed = mesh.velocity.norm();
    if (mesh.turn && mesh.surface)
        speed +=
            std::abs(mesh.turn->rate) * mesh.surface->farthest_from_axis(mesh.turn->through, mesh.turn->axis);
    if (mesh.path) speed += mesh.path->top_speed();
    if (mesh.path && mesh.path->turns() && mesh.surface)
        speed += mesh.path->top_spin() * mesh.surface->farthest_from(mesh.path->pivot());
    return speed;
}

double own_speed(const Container& container) {
    if (!container.turn || container.shape == Container::Shape::none) return 0;
    return std::abs(container.turn->rate) * farthest_from_axis(container, *container.turn);
}

double fastest_own_speed(const Scene& scene) {
    double fastest = own_speed(scene.container);
    for (const SceneMesh& mesh : scene.meshes) fastest = std::max(fastest, own_speed(mesh));
    return fastest;
}

void check_rims(const Scene& scene, double step) {
    if (const double speed = own_speed(scene.container); speed > 0)
        check_rim(scene, "container.turn.rate", "the container's rim", speed, step);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        check_rim(scene, fmt::format("mesh[{}]{}", m, motion_key(mesh)), fmt::format("\"{}\"", mesh.name),
                  own_speed(mesh), step);
    }
}

}  // namespace grainreel
