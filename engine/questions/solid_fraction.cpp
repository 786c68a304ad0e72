#include "engine/questions/solid_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace grainreel {

double sphere_below(double radius, double height) {
    const double t = std::clamp(height / radius, -1.0, 1.0);
    return std::numbers::pi / 3 * radius * radius * radius * (2 + 3 * t - t * t * t);
}

std::vector<double> solid_fractions(const Snapshot& s, double low, double height, std::size_t count) {
    std::vector<double> fractions(count, std::numeric_limits<double>::quiet_NaN());
    const Container& container = s.scene.container;
    if (container.shape == Container::Shape::none) return fractions;
    // The part of a slice that is in the container.
    const auto edge = [&](std::size_t k) {
        return std::clamp(low + static_cast<double>(k) * height, container.base(), container.height);
    };
    std::vector<double> solid(count, 0);
    for (std::size_t i = 0; i < s.frame.size(); ++i) {
        const double z = (s.frame.position[i] - container_offset(s.scene, s.frame)).z(),
                     r = s.frame.radius[i];
        const double first = std::floor((z - r - low) / height), last = std::floor((z + r - low) / height);
        const double most = static_cast<double>(count) - 1;
        if (!(last >= 0 && first <= most)) continue;
        const auto from = static_cast<std::size_t>(std::max(first, 0.0)),
                   to = static_cast<std::size_t>(std::min(last, most));
        for (std::size_t k = from; k <= to; ++k)
            solid[k] += sphere_below(r, edge(k + 1) - z) - sphere_below(r, edge(k) - z);
    }
    for (std::size_t k = 0; k < count; ++k) {
        const double room = container.volume_below(edge(k + 1)) - container.volume_below(edge(k));
        if (room > 0) fractions[k] = solid[k] / room;
    }
    return fractions;
}

}  // namespace grainreel
