#include "render/picture/marks/streamline.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

using Place = Eigen::Vector2d;

// Unit vector of the flow; none where it stands still.
std::optional<Place> direction(const PlaneVelocity& velocity, const Place& at) {
    const std::optional<Place> here = velocity(at);
    if (!here || here->norm() == 0) return std::nullopt;
    return *here / here->norm();
}

// A step along the flow, or against it when it is negative.
std::optional<Place> next(const PlaneVelocity& velocity, const Place& at, double step) {
    const auto a = direction(velocity, at);
    if (!a) return std::nullopt;
    const auto b = direction(velocity, at + 0.5 * step * *a);
    if (!b) return std::nullopt;
    const auto c = direction(velocity, at + 0.5 * step * *b);
    if (!c) return std::nullopt;
    const auto d = direction(velocity, at + step * *c);
    if (!d) return std::nullopt;
    return at + step / 6 * (*a + 2 * *b + 2 * *c + *d);
}

}  // namespace

std::vector<StreamPoint> streamline(const PlaneVelocity& velocity, const Place& seed, double reach,
                                    double step) {
    std::vector<StreamPoint> line;
    const auto first = velocity(seed);
    if (!first || first->norm() == 0) return line;
    const auto walk = [&](double along) {
        Place at = seed;
        const auto steps = static_cast<int>(std::lround(reach / step));
        for (int k = 0; k < steps; ++k) {
            const std::optional<Place> ahead = next(velocity, at, along);
            const std::optional<Place> there = ahead ? velocity(*ahead) : std::nullopt;
            if (!there) return;
            at = *ahead;
            line.push_back({at, there->norm()});
        }
    };
    walk(-step);
    std::reverse(line.begin(), line.end());
    line.push_back({seed, first->norm()});
    walk(step);
    return line;
}

}  // namespace grainreel
