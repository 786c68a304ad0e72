// What the whole bed is like: its height, how hard it is shaken, and how fast its grains meet.
#include <algorithm>
#include <cmath>

#include "engine/plan/contact_kinds.hpp"
#include "engine/plan/drops.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/plan/rain_plan.hpp"
#include "engine/plan/wall_speeds.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"

namespace grainreel {
namespace {

// Settling is short, and nobody looks: overlaps may be this large there.
constexpr double settling_overlap = 0.05;
// A plastic block on the plate hits it at up to 2.13 a omega for Gamma from 1.2 to 10. What a turning wall
// throws up at its own speed v falls back on it at about as much: it is lifted by up to 2 v^2 / g, so that it
// comes back at sqrt(v^2 + 4 v^2).
constexpr double plastic_block_speed = 2.2;

// Top speed of a grain over the drive's a omega. A single ball on a plate of random phase gains and loses
// until <v^2> = (1 + e) / (1 - e) (a omega)^2 / 2, and rarely has more than three times that speed. In a bed
// of n layers a blow passes 2n - 1 contacts before it is back at the plate: e becomes e^(2n-1), and for a
// deep bed that is the plastic block. (The two ends are derived, the exponent is an estimate.)
double speed_over_drive(double restitution, double layers) {
    const double whole = std::min(0.98, std::pow(restitution, 2 * layers - 1));
    return std::max(plastic_block_speed, 3 * std::sqrt((1 + whole) / (2 * (1 - whole))));
}

// m/s: how fast listed grains, or a grain and a wall, may come together.
double closing_speed(const Scene& scene) {
    double fastest = 0;
    Vec3 low = scene.start.grains[0].velocity, high = low;
    const auto take = [&](const Vec3& velocity) {
        low = low.cwiseMin(velocity);
        high = high.cwiseMax(velocity);
        fastest = std::max(fastest, velocity.norm());
    };
    for (const ListedGrain& grain : scene.start.grains) take(grain.velocity);
    for (const FreeWall& wall : scene.walls) take(wall.velocity);
    const bool no_walls =
        scene.walls.empty() && scene.meshes.empty() && scene.container.shape == Container::Shape::none;
    return std::max(no_walls ? 0.0 : fastest, (high - low).norm());
}

// m/s: of grains that come during the run, when they have fallen to the floor.
double fastest_fed(const Scene& scene) {
    double fastest = 0;
    const double floor = lowest_wall(scene);
    for (const Feed& feed : scene.feeds) {
        const double from = scene.meshes.empty() ? feed.high.z() : highest_corner(scene, feed.low, feed.high);
        const double fall = std::max(0.0, from - floor);
        fastest = std::max(fastest, std::sqrt(feed.velocity.squaredNorm() + 2 * scene.gravity.norm() * fall));
    }
    return fastest;
}

}  // namespace

BedPlan plan_bed(const Scene& scene, const StartFacts& file) {
    BedPlan bed;
    const Drive& drive = scene.drive;
    bed.gravity = scene.gravity.norm();
    const DrivePeaks peaks = drive.present ? drive_peaks(drive) : DrivePeaks{};
    bed.frequency = peaks.frequency;
    if (bed.gravity > 0) bed.g_level = peaks.acceleration / bed.gravity;
    bed.height = bed_depth(scene);
    bed.carried_height = std::min(bed.height, 2 * bed_width(scene));
    double diameters = 0;
    for (const Species& s : scene.species) {
        bed.largest_density = std::max(bed.largest_density, s.density);
        if (s.all() > 0) bed.largest_mass = std::max(bed.largest_mass, mass_of(s, s.diameter.largest));
        diameters += static_cast<double>(s.all()) * s.diameter.mean;
    }
    const std::vector<double> shares = contact_shares(scene);
    for (std::size_t a = 0; a < shares.size(); ++a)
        bed.usual_mass += shares[a] * mass_of(scene.species[a], scene.species[a].diameter.mean);
    bed.layers = std::max(1.0, bed.height * static_cast<double>(scene.grains()) / diameters);

    double restitution = 0;
    for (const PairContact& pair : scene.contact.grain) restitution = std::max(restitution, pair.restitution);
    if (drive.present) bed.impact_speed = speed_over_drive(restitution, bed.layers) * peaks.speed;
    const double fall = std::sqrt(2 * bed.gravity * start_drop(scene, bed.height));
    if (scene.start.method == Start::Method::grains) {
        bed.impact_speed += fall + closing_speed(scene);
    } else if (scene.start.method == Start::Method::layers) {
        bed.drop_speed = fall;
        bed.impact_speed = std::max(bed.impact_speed, fall * scene.run.overlap / settling_overlap);
    } else if (scene.start.method == Start::Method::rain) {
        bed.drop_speed = std::sqrt(2 * bed.gravity * rain_drop(scene));
        bed.impact_speed = std::max(bed.impact_speed, bed.drop_speed * scene.run.overlap / settling_overlap);
    } else if (file.known) {
        bed.impact_speed = std::max(bed.impact_speed, file.speed);
    } else if (!drive.present) {
        bed.impact_speed = fall;  // all that one can know of a file that cannot be read
    }
    if (scene.container.tray)
        bed.impact_speed =
            std::max(bed.impact_speed, std::sqrt(2 * bed.gravity * scene.container.tray->depth));
    bed.impact_speed = std::max(bed.impact_speed, std::sqrt(2 * bed.gravity * drop_below(scene)));
    if (!scene.feeds.empty())
        bed.impact_speed = std::max(bed.impact_speed, fastest_fed(scene) + drive.top_speed());
    bed.speed_of_others = bed.impact_speed;
    bed.impact_speed = std::max(bed.impact_speed, plastic_block_speed * fastest_own_speed(scene));
    return bed;
}

}  // namespace grainreel
