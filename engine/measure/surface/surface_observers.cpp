#include "engine/measure/surface/surface_observers.hpp"

#include <algorithm>
#include <vector>

#include "engine/base/mathematics.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {

namespace {

constexpr std::size_t kFewest = 20;  // grains
constexpr double kOutermost = 0.01;  // share of the grains at either end, which may be in flight
constexpr double kStands = 0.5;      // sine of the angle from axis to gravity; below it the axis is upright

// Slope of the least-squares line through the bins between two places.
double slope_between(const BedOutline& surface, double from, double to) {
    double count = 0, y = 0, h = 0, yy = 0, yh = 0;
    for (std::size_t i = 0; i < surface.height.size(); ++i) {
        const double at = surface.place(i), height = surface.height[i];
        if (at < from || at > to) continue;
        count += 1, y += at, h += height, yy += at * at, yh += at * height;
    }
    if (count < 3) return kUnknown;
    return (count * yh - y * h) / (count * yy - y * y);
}

}  // namespace

std::optional<DrumAxes> drum_axes(const BodyTurn& turn, const Vec3& gravity) {
    if (gravity.norm() == 0) return std::nullopt;
    const Vec3 axis = turn.axis.normalized(), against = -gravity.normalized();
    const Vec3 up = against - against.dot(axis) * axis;
    if (up.norm() < kStands) return std::nullopt;
    // At its lowest point the drum moves along the cross product of `axis` and -`up`, and rises on that side.
    // With a negative rate it moves the other way.
    const Vec3 across = up.normalized().cross(axis) * (turn.rate < 0 ? -1.0 : 1.0);
    return DrumAxes{axis, across, up.normalized()};
}

double angle_of_repose(std::span<const Place> grains, const DrumAxes& axes, double diameter) {
    if (grains.size() < kFewest) return kUnknown;
    std::vector<Place> seen;
    std::vector<double> sideways;
    SurfaceAxes frame;
    frame.diameter = diameter;
    for (const Place& grain : grains) {
        const Vec3& p = grain.position;
        seen.push_back({Vec3(axes.along.dot(p), axes.across.dot(p), axes.up.dot(p)), grain.radius});
        sideways.push_back(seen.back().position.y());
    }
    const auto depth = std::minmax_element(seen.begin(), seen.end(), [](const Place& a, const Place& b) {
        return a.position.x() < b.position.x();
    });
    frame.back = depth.first->position.x() - depth.first->radius;
    frame.front = depth.second->position.x() + depth.second->radius;
    std::sort(sideways.begin(), sideways.end());
    const auto out = static_cast<std::size_t>(kOutermost * static_cast<double>(sideways.size()));
    frame.left = sideways[out];
    frame.right = sideways[sideways.size() - 1 - out];
    if (!(frame.right > frame.left)) return kUnknown;
    std::erase_if(seen, [&](const Place& grain) {
        return grain.position.y() < frame.left || grain.position.y() > frame.right;
    });
    const double third = (frame.right - frame.left) / 3;
    return math::atan(slope_between(surface_of(seen, frame), frame.left + third, frame.right - third));
}

double froude_number(double rate, double radius, double gravity) {
    return gravity > 0 ? rate * rate * radius / gravity : kUnknown;
}

}  // namespace grainreel
