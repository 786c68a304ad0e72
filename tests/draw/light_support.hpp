// Beds of spheres in view coordinates, and their light computed with rays.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "render/picture/spheres/light/sphere_layer.hpp"

namespace grainreel::test {

using Point = Eigen::Vector3f;

inline Point centre(const ViewSphere& s) {
    return {s.x, s.y, s.z};
}

struct Hit {
    int sphere = -1;
    float distance = std::numeric_limits<float>::infinity();
};

// The first sphere that a ray of unit direction meets, not counting `skip`.
inline Hit first_hit(const std::vector<ViewSphere>& spheres, const Point& from, const Point& direction,
                     int skip) {
    Hit hit;
    for (int i = 0; i < static_cast<int>(spheres.size()); ++i) {
        if (i == skip) continue;
        const Point to = centre(spheres[i]) - from;
        const float along = to.dot(direction),
                    rest = spheres[i].radius * spheres[i].radius - (to - along * direction).squaredNorm();
        if (rest < 0 || along < 0) continue;
        const float entry = along - std::sqrt(rest);
        if (entry < hit.distance) hit = {i, entry};
    }
    return hit;
}

// A loose bed in view coordinates, seen from above the horizon: balls are dropped one by one to places with
// room, from below. Radii alternate between `radii`.
inline std::vector<ViewSphere> loose_bed(int count, const std::vector<float>& radii, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(-1, 1);
    std::vector<ViewSphere> bed;
    for (int i = 0; i < count; ++i) {
        const float r = radii[static_cast<std::size_t>(i) % radii.size()];
        ViewSphere best{0, std::numeric_limits<float>::infinity(), 0, r};
        for (int attempt = 0; attempt < 200; ++attempt) {
            ViewSphere ball{5 * share(random), r, 14 + 3 * share(random), r};
            for (const ViewSphere& other : bed) {
                const float dx = ball.x - other.x, dz = ball.z - other.z, touch = r + other.radius;
                const float left = touch * touch - dx * dx - dz * dz;
                if (left > 0) ball.y = std::max(ball.y, other.y + std::sqrt(left));
            }
            if (ball.y < best.y) best = ball;
        }
        bed.push_back(best);
    }
    for (ViewSphere& s : bed) s.y -= 3;
    return bed;
}

inline Spheres white(const std::vector<ViewSphere>& bed) {
    Spheres spheres;
    spheres.spheres = bed;
    spheres.albedo.assign(bed.size(), {1, 1, 1});
    return spheres;
}

inline double linear_of(std::uint32_t byte) {
    const double s = byte / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

}  // namespace grainreel::test
