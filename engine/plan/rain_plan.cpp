#include "engine/plan/rain_plan.hpp"

#include <algorithm>
#include <cmath>

#include "engine/plan/drops.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

constexpr double lowest = 2, highest = 6;  // over the largest diameter
constexpr double thin = 0.05;              // solid share of the layer

// m2, of the room's level section.
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
    const double stays = std::sqrt(2 * deep / scene.gravity.norm());  // s, that a grain falls through it
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
