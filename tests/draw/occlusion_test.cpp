// Tests of ambient occlusion against rays from the same points: the share of 256 directions, denser towards
// the normal as the cosine, in which a ray meets nothing.
#include <gtest/gtest.h>

#include "tests/draw/light_support.hpp"

namespace grainreel {
namespace {

using namespace test;

constexpr int kWidth = 160, kHeight = 120, kRays = 256;

// Malley's method on a Fibonacci lattice of the disc gives the directions.
double openness_by_rays(const std::vector<ViewSphere>& bed, int own, const Point& at, const Point& normal) {
    const Point side = normal.unitOrthogonal(), other = normal.cross(side);
    int open = 0;
    for (int k = 0; k < kRays; ++k) {
        const double r = std::sqrt((k + 0.5) / kRays), angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
        const Point direction = side * static_cast<float>(r * std::cos(angle)) +
                                other * static_cast<float>(r * std::sin(angle)) +
                                normal * static_cast<float>(std::sqrt(1 - r * r));
        open += first_hit(bed, at, direction, own).sphere < 0;
    }
    return static_cast<double>(open) / kRays;
}

struct Agreement {
    double mean_error = 0, mean = 0, correlation = 0;
    int points = 0;
};

// Compares every fourth pixel that shows a grain.
Agreement compare_with_rays(const std::vector<ViewSphere>& bed) {
    const Sight sight{false, 130, kWidth / 2, kHeight / 2};
    Lamp lamp;  // only ambient light, the same from all sides
    lamp.key = lamp.shine = 0;
    lamp.sky = lamp.ground = lamp.rim = 1;
    lamp.shadows = false;
    const Spheres spheres = white(bed);
    SphereLayer layer(kWidth, kHeight);
    Team team(1);
    layer.find_visible(sight, {}, spheres, team);
    layer.find_neighbours({}, lamp, spheres, team);
    const Layer& picture = layer.light(sight, {}, lamp, spheres, team);
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0, error = 0;
    for (int y = 0; y < kHeight; y += 2)
        for (int x = 0; x < kWidth; x += 2) {
            if (picture.row(y)[x] >> 24 != 255) continue;
            const Point ray = Point(sight.slope_x(static_cast<float>(x) + 0.5f),
                                    sight.slope_y(static_cast<float>(y) + 0.5f), 1)
                                  .normalized();
            const Hit hit = first_hit(bed, {0, 0, 0}, ray, -1);
            if (hit.sphere < 0 || layer.visibility().row(y)[x] != static_cast<std::uint32_t>(hit.sphere) + 1)
                continue;
            const Point at = hit.distance * ray;
            const ViewSphere& s = bed[static_cast<std::size_t>(hit.sphere)];
            const double rays = openness_by_rays(bed, hit.sphere, at, (at - centre(s)) / s.radius);
            const double ours = linear_of(picture.row(y)[x] & 255);
            n += 1, a += rays, b += ours, aa += rays * rays, bb += ours * ours, ab += rays * ours;
            error += std::abs(rays - ours);
        }
    return {error / n, (b - a) / n, (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n)),
            static_cast<int>(n)};
}

void expect_agreement(const std::vector<ViewSphere>& bed) {
    const Agreement found = compare_with_rays(bed);
    testing::Test::RecordProperty("mean_error", std::to_string(found.mean_error));
    testing::Test::RecordProperty("correlation", std::to_string(found.correlation));
    EXPECT_GT(found.points, 500);
    EXPECT_LT(found.mean_error, 0.1);
    EXPECT_GT(found.correlation, 0.8);
}

TEST(Occlusion, AgreesWithRaysInABedOfEqualGrains) {
    expect_agreement(loose_bed(260, {0.6f}, 1));
}

TEST(Occlusion, AgreesWithRaysInAMixture) {
    expect_agreement(loose_bed(300, {0.8f, 0.4f, 0.4f, 0.4f}, 2));
}

TEST(Occlusion, AgreesWithRaysAroundOneLargeGrain) {
    std::vector<ViewSphere> bed = loose_bed(400, {0.4f}, 3);
    std::erase_if(bed,
                  [](const ViewSphere& s) { return Point(s.x, s.y + 1, s.z - 12).norm() < 2 + s.radius; });
    bed.push_back({0, -1, 12, 2});
    expect_agreement(bed);
}

}  // namespace
}  // namespace grainreel
