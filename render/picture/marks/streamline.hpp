// A piece of a streamline of a plane velocity field.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// m/s at a place (y, z), m; none where there is no flow to speak of.
using PlaneVelocity = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>;

struct StreamPoint {
    Eigen::Vector2d at;  // m
    double speed;        // m/s
};

// Through `seed`, along the flow, up to `reach` (m) on either side of it; shorter where the field ends or
// stands still. Of points `step` (m) apart, by the fourth order method of Runge and Kutta in arc length.
// Empty where the seed has no velocity.
std::vector<StreamPoint> streamline(const PlaneVelocity& velocity, const Eigen::Vector2d& seed, double reach,
                                    double step);

}  // namespace grainreel
