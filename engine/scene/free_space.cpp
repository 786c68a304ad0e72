#include "engine/scene/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

bool in_container(const Container& c, const Vec3& place, double margin) {
    if (place.z() < margin || place.z() > c.height - margin) return false;
    if (c.shape == Container::Shape::cylinder)
        return std::hypot(place.x(), place.y()) <= c.half_width - margin;
    const bool slanted = c.shape == Container::Shape::wedge && place.z() < c.slant_height;
    const double slope = slanted ? std::cos(c.half_angle) : 1;
    if (std::abs(place.y()) > c.half_width_at(place.z()) - margin / slope) return false;
    return c.periodic_depth || std::abs(place.x()) <= c.depth / 2 - margin;
}

// Numbers in [0, 1) that fill a cube evenly (the additive recurrence R3, after M. Roberts 2018: powers of
// 1/g, g^4 = g + 1).
Vec3 evenly(int k) {
    constexpr double g = 1.2207440846057596;
    const auto part = [&](double step) { return std::fmod(0.5 + step * k, 1.0); };
    return {part(1 / g), part(1 / (g * g)), part(1 / (g * g * g))};
}

}  // namespace

bool FreeSpace::before_planes(const Vec3& place, double margin) const {
    return std::all_of(planes_.begin(), planes_.end(), [&](const FreeWall& plane) {
        return plane.normal.dot(place - plane.point) >= margin;
    });
}

bool FreeSpace::holds(const Vec3& place, double margin) const {
    return in_container(container_, place, margin) && before_planes(place, margin);
}

FreeSpace::FreeSpace(const Scene& scene)
    : container_(scene.container), planes_(scene.walls), volume_(scene.container.volume()) {
    if (planes_.empty()) return;
    constexpr int kPlaces = 100'000;
    const bool round = container_.shape == Container::Shape::cylinder;
    const double half_depth = round ? container_.half_width : container_.depth / 2;
    const Vec3 low(-half_depth, -container_.half_width, 0),
        high(half_depth, container_.half_width, container_.height);
    int inside = 0;
    for (int k = 0; k < kPlaces; ++k) {
        const Vec3 place = low + evenly(k).cwiseProduct(high - low);
        if (!in_container(container_, place, 0)) continue;
        ++inside;
        if (before_planes(place, 0)) heights_.push_back(place.z());
    }
    std::sort(heights_.begin(), heights_.end());
    volume_ *= static_cast<double>(heights_.size()) / std::max(inside, 1);
}

double FreeSpace::height_of_share(double share) const {
    if (!planes_.empty()) {
        if (heights_.empty()) return 0;
        const double at = share * static_cast<double>(heights_.size() - 1);
        return heights_[static_cast<std::size_t>(at)];
    }
    const double wanted = share * volume_;
    double low = 0, high = container_.height;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (container_.volume_below(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace grainreel
