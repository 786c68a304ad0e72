#include "engine/plan/reach.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"

namespace grainreel {

namespace {

constexpr double loose_fraction = 0.55;  // solid share of a bed between near walls
constexpr double thrown_faster = 1.6;    // speed of a deep bed's highest grains divided by the plate's
constexpr double upright = 0.95;         // cosine of the largest angle between gravity and -z

bool has_a_bed(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    const Container& c = scene.container;
    const bool vessel_alone = scene.meshes.size() == (c.shape == Container::Shape::mesh ? 1U : 0U);
    const bool stands = !c.turn && vessel_alone && (scene.meshes.empty() || !scene.meshes[0].turn);
    return c.shape != Container::Shape::none && scene.walls.empty() && stands && gravity > 0 &&
           -scene.gravity.z() >= upright * gravity;
}

// Speed of the highest grains divided by that of the plate; the header says where this comes from.
double throw_factor(const Scene& scene) {
    constexpr double scale = 1.8, lost_to_friction = 0.7;
    double e = 0;
    for (const auto* pairs : {&scene.contact.grain, &scene.contact.wall})
        for (const PairContact& pair : *pairs) e = std::max(e, pair.restitution);
    const double layers =
        std::max(1.0, fill_height(scene, loose_fraction) / std::max(1e-30, mean_diameter(scene)));
    return std::max(thrown_faster, scale * (1 + e) / std::sqrt(layers * (1 - e * e + lost_to_friction)));
}

// How far (m) a drive throws the bed above its place at rest.
double throw_height(const Scene& scene) {
    const Drive& drive = scene.drive;
    if (!drive.present) return 0;
    const DrivePeaks peaks = drive_peaks(drive);
    const double gravity = scene.gravity.norm(), stroke = peaks.offset * std::abs(drive.direction.z());
    if (peaks.acceleration <= gravity) return stroke;
    const double speed = throw_factor(scene) * peaks.speed;
    return stroke + speed * speed / (2 * gravity);
}

// Height (m) that listed grains reach by their own flight.
double highest_listed(const Scene& scene) {
    double highest = 0;
    for (const ListedGrain& grain : scene.start.grains) {
        const double up = std::max(0.0, grain.velocity.z());
        highest = std::max(highest,
                           grain.position.z() + 0.5 * grain.diameter + up * up / (2 * scene.gravity.norm()));
    }
    return highest;
}

// Height (m) that fed grains reach: where they appear, and how far they are thrown up from there.
double highest_fed(const Scene& scene) {
    double highest = 0;
    for (const Feed& feed : scene.feeds) {
        const double up = std::max(0.0, feed.velocity.z());
        highest = std::max(highest, feed.high.z() + 0.5 * scene.species[feed.species].diameter.largest +
                                        up * up / (2 * scene.gravity.norm()));
    }
    return highest;
}

}  // namespace

std::optional<double> resting_top(const Scene& scene) {
    if (!has_a_bed(scene)) return {};
    return scene.container.base() + fill_height(scene, loose_fraction);
}

std::optional<double> estimated_reach(const Scene& scene) {
    const std::optional<double> bed = resting_top(scene);
    if (!bed) return {};
    return std::max({*bed + throw_height(scene), highest_listed(scene), highest_fed(scene)});
}

namespace {

constexpr double most_of_a_grain = 0.1;  // a rim may move by this share of the smallest diameter in one step

double distance_from_axis(const BodyTurn& turn, const Vec3& place) {
    const Vec3 from = place - turn.through;
    return (from - turn.axis.dot(from) * turn.axis).norm();
}

// Distance (m) of the container's farthest point from the axis: a corner of a box, or a point of the two
// circles at the ends of a cylinder.
double farthest_from_axis(const Container& c, const BodyTurn& turn) {
    constexpr int places = 90;  // round a circle
    const bool round = c.shape == Container::Shape::cylinder;
    double farthest = 0;
    for (const double z : {0.0, c.height}) {
        for (int k = 0; k < (round ? places : 4); ++k) {
            const double angle = 2 * std::numbers::pi * k / places;
            const Vec3 at = round ? Vec3(c.half_width * math::cos(angle), c.half_width * math::sin(angle), z)
                                  : Vec3((k % 2 - 0.5) * c.depth, (k / 2 * 2 - 1) * c.half_width, z);
            farthest = std::max(farthest, distance_from_axis(turn, at));
        }
    }
    return farthest;
}

// m: the smallest diameter of the species that have grains, at the start or later.
double smallest_that_comes(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Species& species : scene.species)
        if (species.all() > 0) smallest = std::min(smallest, species.diameter.smallest);
    return smallest;
}

// Throws at the key that makes the wall so fast.
void check_rim(const Scene& scene, const std::string& key, const std::string& name, double speed,
               double step) {
    const double smallest = smallest_that_comes(scene), moved = speed * step;
    if (!(moved > most_of_a_grain * smallest)) return;
    throw UserError(
        "{}: {} moves at up to {:.4g} m/s, by {:.3g} m in a step of {:.4g} s, which is {:.2g} of the "
        "smallest "
        "grain, more than {}, so that grains may pass through it; make it at least {:.2g} times slower, or "
        "give a 'run.step' of at most {:.3g} s",
        scene.where(key), name, speed, moved, step, moved / smallest, most_of_a_grain,
        moved / (most_of_a_grain * smallest), most_of_a_grain * smallest / speed);
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
