// Tests of what is seen and what is lit, against rays and formulas.
#include <gtest/gtest.h>

#include "tests/draw/light_support.hpp"

namespace grainreel {
namespace {

using namespace test;

constexpr int kWidth = 200, kHeight = 150;
const Sight kPerspective{false, 160, kWidth / 2, kHeight / 2};
const Sight kOrthographic{true, 14, kWidth / 2, kHeight / 2};

struct Line {
    Point from, direction;  // direction: unit vector
};
Line line_of_sight(const Sight& sight, double x, double y) {
    const float u = sight.slope_x(static_cast<float>(x)), v = sight.slope_y(static_cast<float>(y));
    if (sight.orthographic) return {{u, v, 0}, {0, 0, 1}};
    return {{0, 0, 0}, Point(u, v, 1).normalized()};
}

// The first sphere that the line meets in the part that the cut keeps, found by intervals along the ray.
int seen_through_cut(const std::vector<ViewSphere>& bed, const Cut& cut, const Line& line) {
    double low = 0, high = std::numeric_limits<double>::infinity(), nearest = high;
    for (int i = 0; i < cut.planes; ++i) {
        const Point normal(cut.plane[i].x, cut.plane[i].y, cut.plane[i].z);
        const double slope = normal.dot(line.direction),
                     at = (cut.plane[i].d - normal.dot(line.from)) / slope;
        (slope > 0 ? low : high) = slope > 0 ? std::max(low, at) : std::min(high, at);
    }
    int seen = -1;
    for (int i = 0; i < static_cast<int>(bed.size()); ++i) {
        const Point to = centre(bed[static_cast<std::size_t>(i)]) - line.from;
        const double along = to.dot(line.direction), r = bed[static_cast<std::size_t>(i)].radius;
        const double rest = r * r - (to - static_cast<float>(along) * line.direction).squaredNorm();
        if (rest < 0) continue;
        const double entry = std::max(low, along - std::sqrt(rest)),
                     exit = std::min(high, along + std::sqrt(rest));
        if (entry < exit && entry < nearest) nearest = entry, seen = i;
    }
    return seen;
}

// Share of the pixels that show another grain than rays do; such pixels have their middle on an outline,
// within rounding.
double share_of_errors(const std::vector<ViewSphere>& bed, const Sight& sight, const Cut& cut) {
    Visibility visibility(kWidth, kHeight);
    Team team(1);
    visibility.update(sight, cut, bed, team);
    int wrong = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            wrong += static_cast<int>(visibility.row(y)[x]) - 1 !=
                     seen_through_cut(bed, cut, line_of_sight(sight, x + 0.5, y + 0.5));
    return wrong / static_cast<double>(kWidth * kHeight);
}

TEST(Seen, IsWhatRaysMeetThoughBuriedGrainsAreDropped) {
    const std::vector<ViewSphere> bed = loose_bed(400, {0.5f, 0.3f}, 4);
    EXPECT_LT(share_of_errors(bed, kPerspective, {}), 2e-4);
    EXPECT_LT(share_of_errors(bed, kOrthographic, {}), 2e-4);
}

TEST(Seen, IsWhatRaysMeetInACutBed) {
    const std::vector<ViewSphere> bed = loose_bed(400, {0.5f, 0.3f}, 5);
    const Point normal = Point(0.3f, -0.2f, 0.9f).normalized();
    Cut cut;
    cut.planes = 2;  // a slab
    cut.plane[0] = {normal.x(), normal.y(), normal.z(), normal.dot(Point(0, 0, 13.5f))};
    cut.plane[1] = {-normal.x(), -normal.y(), -normal.z(), -normal.dot(Point(0, 0, 14.5f))};
    EXPECT_LT(share_of_errors(bed, kPerspective, cut), 5e-4);
    EXPECT_LT(share_of_errors(bed, kOrthographic, cut), 5e-4);
}

Layer drawn(const std::vector<ViewSphere>& bed, const Sight& sight, const Lamp& lamp, int threads) {
    const Spheres spheres = white(bed);
    SphereLayer layer(kWidth, kHeight);
    Team team(threads);
    layer.find_visible(sight, {}, spheres, team);
    layer.find_neighbours({}, lamp, spheres, team);
    return layer.light(sight, {}, lamp, spheres, team);
}

TEST(Seen, IsTheSamePictureForAnyNumberOfThreadsAndAnyTime) {
    const std::vector<ViewSphere> bed = loose_bed(300, {0.5f, 0.3f}, 6);
    const Layer once = drawn(bed, kPerspective, {}, 1);
    for (const int threads : {1, 2, 3, 8})
        EXPECT_EQ(drawn(bed, kPerspective, {}, threads).pixels, once.pixels);
}

// A ball is above a far larger one. Its shadow ends where the light that passes its silhouette meets the
// large ball.
TEST(Light, AShadowEndsWhereTheFormulaSays) {
    const std::vector<ViewSphere> bed = {{0, -40, 60, 40}, {-3, 4.5f, 47, 1.5f}};
    Lamp lamp;
    lamp.sky = lamp.ground = lamp.shine = 0;
    lamp.rim = 1;
    lamp.spread = 0.005f;
    lamp.occlusion = false;
    const Sight sight{false, 400, kWidth / 2, kHeight / 2};
    const Layer shaded = drawn(bed, sight, lamp, 1);
    lamp.shadows = false;
    const Layer open = drawn(bed, sight, lamp, 1);
    const Point key(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]);
    // Distance (m) from the shadow's outline to the place of a pixel's middle on the large ball; negative in
    // the shadow.
    const auto outside = [&](double x, double y) {
        const Line line = line_of_sight(sight, x, y);
        const Hit hit = first_hit(bed, line.from, line.direction, -1);
        if (hit.sphere != 0) return std::numeric_limits<double>::quiet_NaN();
        const Point to = centre(bed[1]) - hit.distance * line.direction;
        return static_cast<double>((to - to.dot(key) * key).norm()) - bed[1].radius;
    };
    int in_shadow = 0, wrong = 0;
    for (int y = 2; y < kHeight - 2; ++y)
        for (int x = 2; x < kWidth - 2; ++x) {
            const double here = outside(x + 0.5, y + 0.5), unshaded = linear_of(open.row(y)[x] & 255);
            if (std::isnan(here) || unshaded < 0.05) continue;
            const bool dark = linear_of(shaded.row(y)[x] & 255) < 0.5 * unshaded;
            in_shadow += dark;
            if (dark == (here < 0)) continue;
            bool near_outline = false;  // within 1.5 pixels the formula gives both answers
            for (int k = 0; k < 16; ++k) {
                const double other = outside(x + 0.5 + 1.5 * std::cos(k * std::numbers::pi / 8),
                                             y + 0.5 + 1.5 * std::sin(k * std::numbers::pi / 8));
                near_outline |= !std::isnan(other) && (other < 0) == dark;
            }
            wrong += !near_outline;
        }
    EXPECT_GT(in_shadow, 100);
    EXPECT_EQ(wrong, 0);
}

// Only Lambert's law holds, at the middle of a ball and beside it.
TEST(Light, FollowsTheCosine) {
    Lamp lamp;
    lamp.sky = lamp.ground = lamp.shine = 0;
    lamp.rim = 1;
    const std::vector<ViewSphere> ball = {{0, 0, 30, 5}};
    const Sight sight{true, 10, kWidth / 2, kHeight / 2};
    const Layer layer = drawn(ball, sight, lamp, 1);
    const Point key(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]);
    for (const int x : {70, 85, 100, 115}) {
        const float u = sight.slope_x(static_cast<float>(x) + 0.5f) / 5, v = sight.slope_y(60.5f) / 5;
        const double falls = std::max(0.0f, key.dot(Point(u, v, -std::sqrt(1 - u * u - v * v))));
        EXPECT_NEAR(linear_of(layer.row(60)[x] & 255), lamp.key * falls, 0.005) << x;
    }
}

TEST(Light, ABallTurnsItsDarkHalfRound) {
    Lamp lamp;
    Spheres spheres = white({{0, 0, 30, 5}});
    const Sight sight{true, 10, kWidth / 2, kHeight / 2};
    SphereLayer layer(kWidth, kHeight);
    Team team(1);
    const auto red_at = [&](int x) {
        layer.find_visible(sight, {}, spheres, team);
        layer.find_neighbours({}, lamp, spheres, team);
        return linear_of(layer.light(sight, {}, lamp, spheres, team).row(60)[x] & 255);
    };
    const double plain = red_at(110);
    spheres.poles = {{1, 0, 0}};
    EXPECT_NEAR(red_at(110), plain, 0.01);
    spheres.poles = {{-1, 0, 0}};
    EXPECT_NEAR(red_at(110), plain * lamp.tone, 0.03);
}

}  // namespace
}  // namespace grainreel
