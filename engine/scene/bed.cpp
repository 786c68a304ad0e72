#include "engine/scene/bed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    // Variance left of a normal distribution cut off at two deviations: 1 - 4 phi(2) / erf(sqrt 2).
    const double density_at_cut = std::exp(-2.0) / std::sqrt(2 * std::numbers::pi);
    const double variance =
        d.deviation * d.deviation * (1 - 4 * density_at_cut / std::erf(std::numbers::sqrt2));
    return d.mean * d.mean * d.mean + 3 * d.mean * variance;
}

double solid_volume(const Scene& scene) {
    double volume = 0;
    for (const Species& s : scene.species)
        volume += static_cast<double>(s.count) * std::numbers::pi / 6 * mean_cube(s.diameter);
    return volume;
}

double total_mass(const Scene& scene) {
    double mass = 0;
    for (const Species& s : scene.species)
        mass += static_cast<double>(s.count) * s.density * std::numbers::pi / 6 * mean_cube(s.diameter);
    return mass;
}

double fill_height(const Scene& scene, double solid_fraction) {
    const Container& c = scene.container;
    const double volume = std::min(solid_volume(scene) / solid_fraction, c.volume());
    if (c.shape != Container::Shape::wedge) return c.height * volume / c.volume();
    const double floor = c.floor_half_width();
    const double slope = std::tan(c.half_angle);
    const double slanted = c.depth * c.slant_height * (floor + c.half_width);
    if (volume > slanted) return c.slant_height + (volume - slanted) / (2 * c.depth * c.half_width);
    // depth * (2 floor h + slope h^2) = volume, solved so that slope 0 needs no case of its own.
    const double area = volume / c.depth;
    return area / (floor + std::sqrt(floor * floor + slope * area));
}

double bed_width(const Scene& scene) {
    const Container& c = scene.container;
    const double width = 2 * c.half_width;
    const bool walls_all_round = c.shape != Container::Shape::cylinder && !c.periodic_depth;
    return walls_all_round ? std::min(width, c.depth) : width;
}

}  // namespace grainreel
