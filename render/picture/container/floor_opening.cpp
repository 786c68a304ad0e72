#include "render/picture/container/floor_opening.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

constexpr int kSteps = 96;  // of a full circle
constexpr double kTurn = 2 * std::numbers::pi;

std::vector<double> even_angles() {
    std::vector<double> angles;
    for (int i = 0; i < kSteps; ++i) angles.push_back(kTurn * i / kSteps);
    return angles;
}

Vec3 at(double radius, double angle, double height) {
    return {radius * std::cos(angle), radius * std::sin(angle), height};
}

// reach(angle): m, from the middle to the outline.
template <class Reach>
Pieces around_hole(const Outlet& outlet, const std::vector<double>& angles, double height,
                   const Reach& reach) {
    Pieces pieces;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double a = angles[i], b = angles[(i + 1) % angles.size()];
        const double hole = outlet.half_width;
        pieces.push_back(
            {at(hole, a, height), at(hole, b, height), at(reach(b), b, height), at(reach(a), a, height)});
    }
    return pieces;
}

}  // namespace

Container container_at(const Container& container, double time) {
    Container now = container;
    if (now.outlet && time < now.outlet->opens) now.outlet.reset();
    return now;
}

std::vector<Vec3> rim_of_hole(const Outlet& outlet, double height) {
    std::vector<Vec3> points;
    for (const double angle : even_angles()) points.push_back(at(outlet.half_width, angle, height));
    return points;
}

Pieces disc_around_hole(const Outlet& outlet, double radius, double height) {
    return around_hole(outlet, even_angles(), height, [radius](double) { return radius; });
}

Pieces rectangle_around_hole(const Outlet& outlet, double half_depth, double half_width, double height) {
    std::vector<double> angles = even_angles();
    const double corner = std::atan2(half_width, half_depth);
    for (const double angle : {corner, kTurn / 2 - corner, kTurn / 2 + corner, kTurn - corner})
        angles.push_back(angle);
    std::sort(angles.begin(), angles.end());
    return around_hole(outlet, angles, height, [&](double angle) {
        return std::min(half_depth / std::max(std::abs(std::cos(angle)), 1e-12),
                        half_width / std::max(std::abs(std::sin(angle)), 1e-12));
    });
}

}  // namespace grainreel
