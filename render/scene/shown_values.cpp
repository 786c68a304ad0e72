// The usual ranges of the quantities that pictures show, estimated from the scene alone. The constants come
// from measured beds.
#include "render/scene/shown_values.hpp"
#include "engine/base/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/bed.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

namespace {

// The solid fraction of a bed between near walls, over its whole volume with corners and rough surface.
constexpr double packing = 0.5;

// m/s: the speed of the drive. Without a drive it is the speed of the fastest listed grain, or of a fall
// through the container.
double speed_scale(const Scene& scene) {
    if (scene.drive.present) return scene.drive.top_speed();
    double fastest = std::sqrt(2 * scene.gravity.norm() * scene.container.height);
    for (const ListedGrain& grain : scene.start.grains) fastest = std::max(fastest, grain.velocity.norm());
    return fastest;
}

// m: how far grains fall below the floor, through an outlet.
double drop_below(const Scene& scene) {
    const Container& c = scene.container;
    return c.tray ? c.tray->depth : c.outlet ? c.outlet->exit_depth : 0.0;
}

// The speed that 99 of 100 grains stay below in the course of a film, divided by the drive's speed a ω. In a
// deep bed it is 1.3 to 1.6 (six beds of 5 to 14 layers, restitution 0.5 to 0.8, Gamma 2.5 to 5). A few
// layers of grains that lose little energy gain speed from blow to blow, until <v²> = (1 + e) / (1 - e) (a
// ω)² / 2 for a single ball; for n layers e^(2 n - 1) stands in place of e (as in the plan). In such cases
// the measured values are 2.0 for 1.8 layers with e = 0.8, 2.4 for a ball with e = 0.7, and 2.4 for a gas
// with e = 0.85. The straight line in the code lies above all these values.
double thrown_faster(const Scene& scene) {
    constexpr double deep = 1.8, slope = 0.75, liveliest = 0.98;
    double restitution = 0;
    for (const auto* pairs : {&scene.contact.grain, &scene.contact.wall})
        for (const PairContact& pair : *pairs) restitution = std::max(restitution, pair.restitution);
    const double layers = std::max(1.0, fill_height(scene, packing) / std::max(1e-30, mean_diameter(scene)));
    const double whole = std::min(liveliest, std::pow(restitution, 2 * layers - 1));
    return deep + slope * (std::sqrt((1 + whole) / (2 * (1 - whole))) - std::sqrt(0.5));
}

// m/s: the speed that 99 of 100 grains stay below.
double top_speed(const Scene& scene) {
    const double gravity = scene.gravity.norm(), below = drop_below(scene);
    double fastest =
        scene.drive.present ? thrown_faster(scene) * scene.drive.top_speed() : speed_scale(scene);
    const auto fall = [&](double height, double from_speed) {
        fastest = std::max(fastest, std::sqrt(from_speed * from_speed + 2 * gravity * (height + below)));
    };
    fall(0, 0);
    for (const Feed& feed : scene.feeds) fall(std::max(0.0, feed.high.z()), feed.velocity.norm());
    for (const ListedGrain& grain : scene.start.grains)
        fall(std::max(0.0, grain.position.z()), grain.velocity.norm());
    return fastest;
}

double mass_of(const Species& species) {
    return species.density * std::numbers::pi / 6 * mean_cube(species.diameter);
}

// J: the energy that 99 of 100 grains stay below, if speeds are normally distributed and 1 grain in 100 is
// faster than `speed`. The share of a species with more than the energy E is then 0.01^(E / E0), where E0 is
// the energy of one of its grains at this speed.
double top_energy(const Scene& scene, double speed) {
    constexpr double rare = 0.01;
    const double all = std::max(1.0, static_cast<double>(scene.grains()));
    double low = 0, high = 0;
    for (const Species& species : scene.species)
        if (species.all() > 0) high = std::max(high, 0.5 * mass_of(species) * speed * speed);
    const auto share_above = [&](double energy) {
        double share = 0;
        for (const Species& species : scene.species)
            if (species.all() > 0)
                share += static_cast<double>(species.all()) / all *
                         std::pow(rare, energy / (0.5 * mass_of(species) * speed * speed));
        return share;
    };
    if (!(high > 0)) return 0;
    constexpr int halvings = 40;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (share_above(middle) > rare ? low : high) = middle;
    }
    return high;
}

// m: the height of the topmost centres when the film begins.
double top_of_bed(const Scene& scene) {
    if (scene.start.method == Start::Method::grains) {
        double highest = 0;
        for (const ListedGrain& grain : scene.start.grains) highest = std::max(highest, grain.position.z());
        if (highest > 0) return highest;
    }
    if (scene.gravity.norm() == 0) return scene.container.height;
    const double half = scene.grains() > 0 ? 0.5 * mean_diameter(scene) : 0;
    return fill_height(scene, packing) + half;  // plus half a grain, since the surface is uneven
}

// N: the force on a grain of mean volume under the weight of the bed, at the drive's peak acceleration.
double force_scale(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    const double peak =
        scene.drive.present ? gravity * (1 + scene.drive.strongest_g_level(gravity)) : gravity;
    const double grains = std::max(1.0, static_cast<double>(scene.grains()));
    const double volume = solid_volume(scene), area = std::pow(volume / grains, 2.0 / 3.0);
    const double pressure = total_mass(scene) / volume * packing * peak * fill_height(scene, packing);
    return pressure * area;
}

// N: the force that 99 of 100 grains stay below. At rest it was 11 and 14 times force_scale() (an hourglass,
// a heap); under the blows of a drive, which are short and hard, 7 to 26 times (seven beds).
double top_force(const Scene& scene) {
    constexpr double at_rest = 14, under_blows = 28;
    return (scene.drive.present ? under_blows : at_rest) * force_scale(scene);
}

}  // namespace

std::array<double, 2> usual_range(GrainValue value, const Scene& scene) {
    const double speed = top_speed(scene);
    // A film locked to a phase may show the bed in flight. In five beds 99 of 100 grains came less far than
    // four amplitudes.
    const double way = std::max(smallest_diameter(scene), 4 * scene.drive.largest_amplitude());
    switch (value) {
        case GrainValue::speed:
            return {0, speed};
        case GrainValue::vertical_velocity:
            return {-speed, speed};
        case GrainValue::start_height:
            return {0, top_of_bed(scene)};
        case GrainValue::displacement:
            return {0, way};
        case GrainValue::rise:
            return {-way, way};
        case GrainValue::spin:
            return {0, 2 * speed / smallest_diameter(scene)};
        case GrainValue::kinetic_energy:
            return {0, top_energy(scene, speed)};
        case GrainValue::coordination:
            return {0, 8};
        case GrainValue::contact_force:
            return {0, top_force(scene)};
        case GrainValue::species:
        case GrainValue::own:
            break;
    }
    return {0, 0};
}

double widest_chain_force(const Scene& scene) {
    return 4 * force_scale(scene);  // more than the scale, since the bed comes down hard
}

double usual_flow_speed(const Scene& scene, bool period) {
    if (period) return 0.2 * smallest_diameter(scene) * scene.drive.highest_frequency();
    const auto& outlet = scene.container.outlet;
    const double fall = outlet ? std::sqrt(2 * outlet->half_width * scene.gravity.norm()) : 0;
    return std::max(fall, speed_scale(scene));
}

std::array<double, 2> usual_profile_range(const Scene& scene, const FilmPlot& plot) {
    const double speed = usual_flow_speed(scene, plot.period);
    switch (plot.profile) {
        case ProfileOf::solid_fraction:
            return {0, 0.8};
        case ProfileOf::share:
            return {0, 1};
        case ProfileOf::horizontal_velocity:
        case ProfileOf::vertical_velocity:
            return {-speed, speed};
        case ProfileOf::nothing:
            break;
    }
    return {0, 0};
}

namespace {

// The solid fraction of a bed at rest.
constexpr double resting_packing = 0.6;

// m: the height of the grains in the container. Without a container it is the height of a heap that is as
// high as it is wide.
double bed_height(const Scene& scene) {
    if (scene.container.shape != Container::Shape::none) return fill_height(scene, resting_packing);
    return std::cbrt(solid_volume(scene) / resting_packing);
}

// Pa: the pressure under the bed's weight.
double weight_pressure(const Scene& scene) {
    const double volume = solid_volume(scene);
    if (!(volume > 0)) return 0;
    const double height = std::max(bed_height(scene), mean_diameter(scene));
    return total_mass(scene) / volume * resting_packing * scene.gravity.norm() * height;
}

// m: the distance of the farthest point of the mesh from the axis of its turn.
double rim_of(const SceneMesh& mesh, const BodyTurn& turn) {
    double rim = 0;
    for (const Vec3& at : mesh.shape().vertices)
        rim = std::max(rim, (at - turn.through).cross(turn.axis).norm());
    return rim;
}

// m/s: the highest speed of a mesh.
double top_speed(const Scene& scene, const SceneMesh& mesh) {
    double speed = mesh.velocity.norm();
    if (mesh.turn) speed += std::abs(mesh.turn->rate) * rim_of(mesh, *mesh.turn);
    if (mesh.driven && scene.drive.present) speed += scene.drive.top_speed();
    if (mesh.path) speed += mesh.path->top_speed() + mesh.path->top_spin() * (mesh.high - mesh.low).norm();
    return speed;
}

// m/s: the speed at which grains rub on meshes. Where all meshes stand still, it is the speed of grains that
// fall by their diameter.
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
    constexpr double slip = 0.3;  // share of the rubbing speed: grains mostly go along with a wall
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
