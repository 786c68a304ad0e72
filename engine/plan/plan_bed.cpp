// What the whole bed is like: its height, how hard it is shaken, and how fast its grains meet.
#include "engine/plan/plan_bed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/mathematics.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/contact_kinds.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/plan/reach.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/free_space.hpp"

namespace grainreel {

namespace {

// Settling is short and is not shown, so overlaps may be this large there.
constexpr double settling_overlap = 0.05;
// Top speed of a bed that acts as a plastic block, divided by a omega (the drive's amplitude times its
// angular frequency): the bed hits the plate at up to 2.13 a omega for Gamma from 1.2 to 10. Grains that a
// turning wall throws up at its own speed v fall back on it about as fast: they are lifted by up to 2 v^2 /
// g, so they come back at sqrt(v^2 + 4 v^2).
constexpr double plastic_block_speed = 2.2;

// Top speed of a grain, divided by the drive's a omega. A single ball on a plate of random phase gains and
// loses until <v^2> = (1 + e) / (1 - e) (a omega)^2 / 2, and rarely has more than three times that speed. In
// a bed of n layers a blow passes 2n - 1 contacts before it is back at the plate: e becomes e^(2n-1), and for
// a deep bed that is the plastic block. (The two ends are derived, the exponent is an estimate.)
double speed_over_drive(double restitution, double layers) {
    const double whole = std::min(0.98, math::pow(restitution, 2 * layers - 1));
    return std::max(plastic_block_speed, 3 * std::sqrt((1 + whole) / (2 * (1 - whole))));
}

// How fast (m/s) listed grains, or a grain and a wall, may come together.
double closing_speed(const Scene& scene) {
    double fastest = 0;
    Vec3 low = scene.start.grains[0].velocity, high = low;
    const auto take = [&](const Vec3& velocity) {
        low = low.cwiseMin(velocity);
        high = high.cwiseMax(velocity);
        fastest = std::max(fastest, velocity.norm());
    };
    for (const ListedGrain& grain : scene.start.grains) take(grain.velocity);
    for (const ScenePlane& wall : scene.walls) take(wall.velocity);
    const bool no_walls =
        scene.walls.empty() && scene.meshes.empty() && scene.container.shape == Container::Shape::none;
    return std::max(no_walls ? 0.0 : fastest, (high - low).norm());
}

// Speed (m/s) of grains that come during the run, when they have fallen to the floor.
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
        bed.impact_speed = fall;  // nothing more is known of a file that cannot be read
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

namespace {

constexpr double loose_fraction = 1.0 / 3;  // solid share of the loose crowd in which grains start in layers

Vec3 up_of(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    return gravity > 0 ? Vec3(-scene.gravity / gravity) : Vec3(0, 0, 1);
}

// Whether the scene is empty space with meshes, without listed grains. With listed grains the extent of the
// space says how far they fall.
bool is_space_with_meshes(const Scene& scene) {
    return scene.container.shape == Container::Shape::none && !scene.meshes.empty() &&
           scene.start.grains.empty();
}

// The container's box; for a vessel, the part of its box where grains have room.
Region box_of(const Container& c, const SceneMesh* vessel) {
    const double x = c.shape == Container::Shape::cylinder ? c.half_width : 0.5 * c.depth;
    if (vessel == nullptr) return {Vec3(-x, -c.half_width, 0), Vec3(x, c.half_width, c.height)};
    Region box{vessel->surface->facts().low, vessel->surface->facts().high};
    box.low.z() = c.base(), box.high.z() = c.height;
    return box;
}

// Height (m) of the top of the grains that start in the region. Where gravity is along z, it is the top of a
// loose crowd of grains.
double top_of_region(const Scene& scene) {
    const Region& region = *scene.start.region;
    if (up_of(scene) != Vec3(0, 0, 1)) return highest_corner(scene, region.low, region.high);
    const FreeSpace room(scene);
    const double share = room.volume() > 0 ? solid_volume(scene) / loose_fraction / room.volume() : 1;
    return room.height_of_share(std::min(1.0, share));
}

}  // namespace

double highest_corner(const Scene& scene, const Vec3& low, const Vec3& high) {
    const Vec3 up = up_of(scene);
    return up.cwiseProduct(low).cwiseMax(up.cwiseProduct(high)).sum();
}

double lowest_corner(const Scene& scene, const Vec3& low, const Vec3& high) {
    const Vec3 up = up_of(scene);
    return up.cwiseProduct(low).cwiseMin(up.cwiseProduct(high)).sum();
}

double bed_depth(const Scene& scene) {
    if (!is_space_with_meshes(scene)) return fill_height(scene, settled_solid_fraction);
    const double volume = solid_volume(scene) / settled_solid_fraction;
    if (!scene.start.region) return math::cbrt(volume);
    const Vec3 size = scene.start.region->high - scene.start.region->low;
    return std::min(volume / (size.x() * size.y()), size.z());
}

double lowest_wall(const Scene& scene) {
    if (scene.meshes.empty()) return 0;
    const bool space = scene.container.shape == Container::Shape::none && scene.walls.empty();
    double lowest = std::numeric_limits<double>::infinity();
    if (!space) {
        const Region box = box_of(scene.container, scene.vessel());
        lowest = lowest_corner(scene, box.low, box.high);
    }
    for (const SceneMesh& mesh : scene.meshes) {
        if (&mesh == scene.vessel()) continue;
        const MeshFacts& facts = mesh.surface->facts();
        lowest = std::min(lowest, lowest_corner(scene, facts.low, facts.high));
    }
    return lowest;
}

double start_drop(const Scene& scene, double depth) {
    const Container& c = scene.container;
    if (scene.start.region && scene.start.packs())
        return std::max(0.0, top_of_region(scene) - lowest_wall(scene));
    if (!is_space_with_meshes(scene)) return c.height - c.base() - depth;
    return 0;  // all grains are fed
}

double drop_below(const Scene& scene) {
    if (scene.meshes.empty()) return 0;
    if (scene.start.region)
        return std::max(0.0, lowest_corner(scene, scene.start.region->low, scene.start.region->high) -
                                 lowest_wall(scene));
    if (scene.container.shape == Container::Shape::none) return 0;
    const Region box = box_of(scene.container, scene.vessel());
    return std::max(0.0, lowest_corner(scene, box.low, box.high) - lowest_wall(scene));
}

namespace {

constexpr double lowest = 2, highest = 6;  // bounds of the layer of rain above the bed, in largest diameters
constexpr double thin = 0.05;              // solid share of this layer

// Area (m2) of the room's level section, the mean over its height.
double mean_area(const Scene& scene) {
    const Container& c = scene.container;
    if (!scene.start.region) return c.volume() / (c.height - c.base());
    const Vec3 size = scene.start.region->high - scene.start.region->low;
    return size.x() * size.y();
}

}  // namespace

RainLayer rain_layer(const Scene& scene) {
    const double largest = largest_diameter(scene);
    return {lowest * largest, highest * largest};
}

double rain_drop(const Scene& scene) {
    const double high = rain_layer(scene).high;
    if (!scene.start.region) return std::min(high, scene.container.height - scene.container.base());
    const Region& region = *scene.start.region;
    const double below = drop_below(scene);
    return std::min(high, region.high.z() - region.low.z()) + below;
}

double rain_rate(const Scene& scene) {
    if (scene.start.rain_rate) return *scene.start.rain_rate;
    const RainLayer layer = rain_layer(scene);
    const double deep = layer.high - layer.low, area = mean_area(scene);
    const double stays =
        std::sqrt(2 * deep / scene.gravity.norm());  // s, time in which a grain falls through it
    const double volume = solid_volume(scene) / static_cast<double>(scene.grains());
    return thin * area * deep / volume / stays;
}

double rain_patience(const Scene& scene) {
    return 5 * std::sqrt(2 * rain_layer(scene).high / scene.gravity.norm());
}

double rain_limit(const Scene& scene) {
    return 2 * static_cast<double>(scene.grains_at_start()) / rain_rate(scene) + rain_patience(scene);
}

}  // namespace grainreel
