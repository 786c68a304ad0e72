#include "engine/plan/reach.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"

namespace grainreel {
namespace {

constexpr double loose_fraction = 0.55;  // solid, of a bed between walls that are near
constexpr double thrown_faster = 1.6;    // than the plate moves
constexpr double upright = 0.95;         // cosine of the largest angle between gravity and -z

bool has_a_bed(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    const Container& c = scene.container;
    const bool vessel_alone = scene.meshes.size() == (c.shape == Container::Shape::mesh ? 1U : 0U);
    const bool stands = !c.turn && vessel_alone && (scene.meshes.empty() || !scene.meshes[0].turn);
    return c.shape != Container::Shape::none && scene.walls.empty() && stands && gravity > 0 &&
           -scene.gravity.z() >= upright * gravity;
}

// m: how far a drive throws the bed above where it rests.
double throw_height(const Scene& scene) {
    const Drive& drive = scene.drive;
    if (!drive.present) return 0;
    const DrivePeaks peaks = drive_peaks(drive);
    const double gravity = scene.gravity.norm(), stroke = peaks.offset * std::abs(drive.direction.z());
    if (peaks.acceleration <= gravity) return stroke;
    const double speed = thrown_faster * peaks.speed;
    return stroke + speed * speed / (2 * gravity);
}

// m: of grains placed by hand, where their own flight takes them.
double highest_listed(const Scene& scene) {
    double highest = 0;
    for (const ListedGrain& grain : scene.start.grains) {
        const double up = std::max(0.0, grain.velocity.z());
        highest = std::max(highest,
                           grain.position.z() + 0.5 * grain.diameter + up * up / (2 * scene.gravity.norm()));
    }
    return highest;
}

// m: of grains that come during the run, where they appear and how far they are thrown up from there.
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

}  // namespace grainreel
