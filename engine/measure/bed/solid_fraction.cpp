#include "engine/measure/bed/solid_fraction.hpp"

#include <algorithm>
#include <numbers>

#include "engine/measure/no_value.hpp"

namespace grainreel {

double solid_fraction(const Container& container, const Grains& grains, double floor, double top) {
    const double height = std::min(top - floor, container.height);
    if (container.shape == Container::Shape::none || !(height > container.base())) return kNoValue;
    double solid = 0;
    for (const Place& p : grains.place) {
        const double r = p.radius, cap = std::clamp(floor + height - (p.position.z() - r), 0.0, 2 * r);
        solid += std::numbers::pi * cap * cap * (3 * r - cap) / 3;
    }
    return solid / container.volume_below(height);
}

}  // namespace grainreel
