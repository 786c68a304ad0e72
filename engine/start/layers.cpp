#include "engine/start/layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/base/random.hpp"

namespace grainreel {

namespace {

constexpr double kLooseFraction = 1.0 / 3;  // solid share of the space the centres are drawn in

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

// z below which the share of the container's volume lies.
double height_of_share(const Container& container, double share) {
    const double wanted = share * container.volume();
    double low = 0, high = container.height;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (container.volume_below(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Vec3 random_centre(const Container& c, double bottom, double top, double margin, Random& random) {
    for (;;) {
        const double z = random.between(bottom, top);
        const double half_width = c.half_width;
        const double half_depth = c.shape == Container::Shape::cylinder ? c.half_width : c.depth / 2;
        const Vec3 centre(random.between(-half_depth, half_depth), random.between(-half_width, half_width),
                          z);
        if (z < margin || z > c.height - margin) continue;
        if (c.shape == Container::Shape::cylinder) {
            if (std::hypot(centre.x(), centre.y()) > c.half_width - margin) continue;
        } else {
            const double slope =
                c.shape == Container::Shape::wedge && z < c.slant_height ? std::cos(c.half_angle) : 1;
            if (std::abs(centre.y()) > c.half_width_at(z) - margin / slope) continue;
            if (!c.periodic_depth && std::abs(centre.x()) > half_depth - margin) continue;
        }
        return centre;
    }
}

double mean_diameter(const Species& s) {
    return 0.5 * (s.diameter.smallest + s.diameter.largest);
}

double solid_volume(const Species& s) {
    return static_cast<double>(s.count) * std::numbers::pi / 6 * std::pow(mean_diameter(s), 3);
}

}  // namespace

Grains place_in_layers(const Scene& scene) {
    std::vector<std::size_t> upwards(scene.species.size());
    std::iota(upwards.begin(), upwards.end(), std::size_t{0});
    std::stable_sort(upwards.begin(), upwards.end(), [&](std::size_t a, std::size_t b) {
        return mean_diameter(scene.species[a]) > mean_diameter(scene.species[b]);
    });
    double all = 0;
    for (const Species& s : scene.species) all += solid_volume(s);
    const double filled = std::min(1.0, all / kLooseFraction / scene.container.volume());
    std::vector<double> bottom(scene.species.size()), top(scene.species.size());
    double share = 0;
    for (const std::size_t s : upwards) {
        bottom[s] = height_of_share(scene.container, filled * share);
        share += solid_volume(scene.species[s]) / all;
        top[s] = height_of_share(scene.container, filled * std::min(share, 1.0));
    }

    Random diameters(scene.run.seed, Stream::diameters), centres(scene.run.seed, Stream::centres);
    Grains grains;
    grains.reserve(scene.grains());
    std::int32_t id = 0;
    for (std::size_t s = 0; s < scene.species.size(); ++s) {
        const Species& species = scene.species[s];
        for (std::int64_t k = 0; k < species.count; ++k) {
            const double radius = 0.5 * draw_diameter(species.diameter, diameters);
            const double margin = std::min(0.25 * radius, 0.25 * (top[s] - bottom[s]));
            const Vec3 centre = random_centre(scene.container, bottom[s], top[s], margin, centres);
            grains.add(id++, static_cast<std::int32_t>(s), centre, radius, species.density);
        }
    }
    return grains;
}

}  // namespace grainreel
