#include "engine/measure/bed/intruder.hpp"

#include <cmath>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/measure/surface/surface.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

std::optional<std::size_t> find_intruder(const Scene& scene, const Grains& grains) {
    if (scene.species.size() < 2) return std::nullopt;
    const auto big = static_cast<std::int32_t>(big_and_small(scene.species).big);
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        if (grains.species[i] != big) continue;
        if (found) return std::nullopt;
        found = i;
    }
    return found;
}

double intruder_height(const Scene& scene, const Grains& grains, std::size_t intruder, double floor) {
    const double period = period_of_depth(scene.container);
    const Place& own = grains.place[intruder];
    double diameters = 0;
    for (const Place& p : grains.place) diameters += 2 * p.radius;
    const double mean = (diameters - 2 * own.radius) / static_cast<double>(grains.size() - 1);
    const double reach = own.radius + 2 * mean;
    std::vector<Place> around;  // places against the intruder's own in x and y
    for (std::size_t i = 0; i < grains.size(); ++i) {
        Place p = grains.place[i];
        p.position.x() = nearest_image(p.position.x() - own.position.x(), period);
        p.position.y() -= own.position.y();
        const bool near = std::abs(p.position.x()) < reach && std::abs(p.position.y()) < reach;
        if (i != intruder && near) around.push_back(p);
    }
    if (around.empty()) return kNoValue;
    const BedOutline surface = surface_of(around, {-reach, reach, -reach, reach, 0, mean});
    return (own.position.z() + own.radius - floor) / (surface.mean() - floor);
}

}  // namespace grainreel
