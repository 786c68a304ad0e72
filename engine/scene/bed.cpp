#include "engine/scene/bed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/random.hpp"
#include "engine/mesh/room.hpp"

namespace grainreel {

double mean_cube(const SizeSpread& d) {
    switch (d.kind) {
        case SizeSpread::Kind::fixed:
            return d.mean * d.mean * d.mean;
        case SizeSpread::Kind::uniform:  // integral of d^3 over the interval, divided by its length
            return (d.smallest + d.largest) * (d.smallest * d.smallest + d.largest * d.largest) / 4;
        case SizeSpread::Kind::normal:
            break;
    }
    // The variance of a normal distribution that is cut off at two deviations, divided by that of the whole
    // distribution, is 1 - 4 phi(2) / erf(sqrt 2).
    const double density_at_cut = math::exp(-2.0) / std::sqrt(2 * std::numbers::pi);
    const double variance =
        d.deviation * d.deviation * (1 - 4 * density_at_cut / (1 - math::erfc(std::numbers::sqrt2)));
    return d.mean * d.mean * d.mean + 3 * d.mean * variance;
}

double smallest_diameter(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Species& species : scene.species) smallest = std::min(smallest, species.diameter.smallest);
    return smallest;
}

double largest_diameter(const Scene& scene) {
    double largest = 0;
    for (const Species& species : scene.species) largest = std::max(largest, species.diameter.largest);
    return largest;
}

double solid_volume(const Scene& scene) {
    double volume = 0;
    for (const Species& s : scene.species)
        volume += static_cast<double>(s.all()) * std::numbers::pi / 6 * mean_cube(s.diameter);
    return volume;
}

double mean_diameter(const Scene& scene) {
    double sum = 0;
    for (const Species& species : scene.species)
        sum += static_cast<double>(species.all()) * species.diameter.mean;
    return sum / static_cast<double>(scene.grains());
}

double total_mass(const Scene& scene) {
    double mass = 0;
    for (const Species& s : scene.species)
        mass += static_cast<double>(s.all()) * s.density * std::numbers::pi / 6 * mean_cube(s.diameter);
    return mass;
}

Species glued_species(const Scene& scene) {
    Species species = scene.species[scene.container.wall_grains->species];
    species.density = std::numeric_limits<double>::infinity();
    return species;
}

PairContact glued_contact(const Scene& scene, std::size_t species) {
    PairContact contact = scene.between(species, scene.container.wall_grains->species);
    if (contact.glued_stiffness) contact.stiffness = contact.glued_stiffness;
    return contact;
}

namespace {

// Height (m) above the room's base to which this volume fills it.
double filled_to(const EnclosedRoom& room, double volume) {
    double low = room.base(), high = room.top();
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (room.volume_below(middle) < volume ? low : high) = middle;
    }
    return high - room.base();
}

}  // namespace

double fill_height(const Scene& scene, double solid_fraction) {
    const Container& c = scene.container;
    const double volume = std::min(solid_volume(scene) / solid_fraction, c.volume());
    if (c.shape == Container::Shape::mesh) return filled_to(*c.room, volume);
    if (c.shape != Container::Shape::wedge) return c.height * volume / c.volume();
    const double floor = c.floor_half_width();
    const double slope = math::tan(c.half_angle);
    const double slanted = c.depth * c.slant_height * (floor + c.half_width);
    if (volume > slanted) return c.slant_height + (volume - slanted) / (2 * c.depth * c.half_width);
    // Solves depth * (2 floor h + slope h^2) = volume, in a form that also holds for slope 0.
    const double area = volume / c.depth;
    return area / (floor + std::sqrt(floor * floor + slope * area));
}

namespace {

// Adds the part of each mesh that lies within `margin` (m) of the box, and the whole of a mesh that is no
// larger than `largest` (m).
void take_meshes(const Scene& scene, double margin, double largest, Extent& extent) {
    const Vec3 low = extent.low - margin * Vec3::Ones(), high = extent.high + margin * Vec3::Ones();
    for (const SceneMesh& mesh : scene.meshes) {
        const bool whole = (mesh.high - mesh.low).norm() <= largest;
        const Vec3 from = whole ? mesh.low : Vec3(mesh.low.cwiseMax(low));
        const Vec3 to = whole ? mesh.high : Vec3(mesh.high.cwiseMin(high));
        if ((to - from).minCoeff() < 0) continue;
        extent.take(from);
        extent.take(to);
    }
}

// Adds the circles along which the corners of the box turn.
void take_turned(const BodyTurn& turn, Extent& extent) {
    const Vec3 reach = (Vec3::Ones() - turn.axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    const Extent rest = extent;
    for (int k = 0; k < 8; ++k) {
        const Vec3 corner((k & 1 ? rest.high : rest.low).x(), (k & 2 ? rest.high : rest.low).y(),
                          (k & 4 ? rest.high : rest.low).z());
        const Vec3 along = turn.axis.dot(corner - turn.through) * turn.axis;
        const double radius = (corner - turn.through - along).norm();
        extent.take(turn.through + along - radius * reach);
        extent.take(turn.through + along + radius * reach);
    }
}

Extent extent_of_container(const Scene& scene) {
    const Container& c = scene.container;
    if (const SceneMesh* vessel = scene.vessel()) return {vessel->low, vessel->high};
    const double x = c.shape == Container::Shape::cylinder ? c.half_width : 0.5 * c.depth;
    const double y = std::max(c.half_width, c.tray ? c.tray->half_width : 0.0);
    const double low = c.tray ? -c.tray->depth : c.outlet ? -c.outlet->exit_depth : 0.0;
    const double out = c.shape == Container::Shape::cylinder ? y : x;
    Extent extent{Vec3(-out, -y, low), Vec3(out, y, c.height)};
    if (c.turn && c.shape != Container::Shape::cylinder) take_turned(*c.turn, extent);
    return extent;
}

// The box of listed grains and of their flights, undisturbed or thrown back by the first wall, up to five
// times the grains' own extent. For a start from a file only the size of the grains is known.
Extent extent_of_grains(const Scene& scene) {
    const Vec3 margin = largest_diameter(scene) * Vec3::Ones();
    if (scene.start.region) return {scene.start.region->low, scene.start.region->high};
    if (scene.start.grains.empty()) {
        const double side = math::cbrt(solid_volume(scene) / 0.2);
        return {-0.5 * side * Vec3::Ones() - margin, 0.5 * side * Vec3::Ones() + margin};
    }
    Extent extent{scene.start.grains[0].position, scene.start.grains[0].position};
    for (const ListedGrain& g : scene.start.grains) extent.take(g.position);
    const double farthest = 5 * (extent.size() + 2 * margin).norm();
    for (const ListedGrain& g : scene.start.grains) {
        Vec3 flight = scene.run.duration * g.velocity;
        if (flight.norm() > farthest) flight *= farthest / flight.norm();
        if (scene.walls.empty()) extent.take(g.position + flight);
        for (const ScenePlane& wall : scene.walls) {
            const double height = wall.normal.dot(g.position - wall.point);
            if (std::abs(height) < farthest) extent.take(g.position - height * wall.normal);
            const double towards = std::min(0.0, wall.normal.dot(flight));
            extent.take(g.position + flight - 2 * towards * wall.normal);
        }
    }
    return {extent.low - margin, extent.high + margin};
}

}  // namespace

Extent extent_of(const Scene& scene) {
    const bool none = scene.container.shape == Container::Shape::none;
    Extent extent = none ? extent_of_grains(scene) : extent_of_container(scene);
    const double size = extent.size().norm();
    if (none)
        take_meshes(scene, 3 * size, 30 * size, extent);
    else
        take_meshes(scene, size, 0, extent);
    return extent;
}

Container tray_container(const Scene& scene) {
    const Container& above = scene.container;
    const double lowest =
        scene.drive.present ? 2 * scene.drive.largest_amplitude() * std::abs(scene.drive.direction.z()) : 0;
    Container tray;
    tray.shape = above.shape == Container::Shape::cylinder ? above.shape : Container::Shape::box;
    tray.half_width = above.tray->half_width;
    tray.depth = above.depth;
    tray.periodic_depth = above.periodic_depth;
    tray.height = above.tray->depth - lowest;
    tray.lid = false;
    return tray;
}

double bed_width(const Scene& scene) {
    const Container& c = scene.container;
    const double width = 2 * c.half_width;
    const bool walls_all_round = c.shape != Container::Shape::cylinder && !c.periodic_depth;
    return walls_all_round ? std::min(width, c.depth) : width;
}

double draw_diameter(const SizeSpread& spread, Random& random) {
    switch (spread.kind) {
        case SizeSpread::Kind::fixed:
            return spread.largest;
        case SizeSpread::Kind::uniform:
            return random.between(spread.smallest, spread.largest);
        case SizeSpread::Kind::normal:
            break;
    }
    for (;;) {
        const double d = spread.mean + spread.deviation * random.normal();
        if (d >= spread.smallest && d <= spread.largest) return d;
    }
}

}  // namespace grainreel
