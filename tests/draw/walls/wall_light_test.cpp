// Tests of the light on walls beside grains, against rays and closed forms.
#include "render/picture/spheres/light/wall_light.hpp"

#include <gtest/gtest.h>

#include "tests/draw/light_support.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

constexpr int kWidth = 200, kHeight = 150;
const Sight kSight{false, 160, kWidth / 2, kHeight / 2};

WallFace face(std::vector<Vec3> corners, const Vec3& inward, int wall) {
    WallFace made{std::move(corners), 1, false};
    made.inward = inward;
    made.taken = 1;
    made.wall = wall;
    return made;
}
WallFace back_wall() {
    return face({{-9, -7, 20}, {9, -7, 20}, {9, 7, 20}, {-9, 7, 20}}, {0, 0, -1}, 1);
}
WallFace floor_face() {
    return face({{-9, -3, 8}, {9, -3, 8}, {9, -3, 20}, {-9, -3, 20}}, {0, 1, 0}, 0);
}

// A lamp that gives walls one tone, whatever their direction.
Lamp even_lamp() {
    Lamp lamp;
    lamp.ground = lamp.sky;
    lamp.shadows = false;
    return lamp;
}

struct Lit {
    Lit(const std::vector<ViewSphere>& bed, const std::vector<WallFace>& faces, const Lamp& lamp, int threads,
        float corner_reach = 1)
        : light(kWidth, kHeight) {
        Team team(threads);
        const Spheres spheres = white(bed);
        SphereLayer layer(kWidth, kHeight);
        layer.find_visible(kSight, {}, spheres, team);
        layer.find_neighbours({}, lamp, spheres, team);
        grains.assign(layer.visibility().row(0), layer.visibility().row(0));
        for (int y = 0; y < kHeight; ++y)
            grains.insert(grains.end(), layer.visibility().row(y), layer.visibility().row(y) + kWidth);
        light.light_faces(layer.takers(kSight, {}, lamp, spheres), faces, corner_reach, team);
    }
    bool shows_wall(int x, int y) const { return grains[static_cast<std::size_t>(y * kWidth + x)] == 0; }
    double share(int x, int y) const { return light.row(y)[x] / 255.0; }

    WallLight light;
    std::vector<std::uint32_t> grains;
};

Point seen_on_back_wall(int x, int y) {
    return 20 * Point(kSight.slope_x(static_cast<float>(x) + 0.5f),
                      kSight.slope_y(static_cast<float>(y) + 0.5f), 1);
}

// The share of the lamp's disc from which no ball is in the way.
double lamp_seen(const std::vector<ViewSphere>& bed, const Point& from, const Lamp& lamp) {
    const Point key(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]);
    const Point u = key.unitOrthogonal(), v = key.cross(u);
    constexpr int kRays = 400;
    int free = 0;
    for (int k = 0; k < kRays; ++k) {
        const float out = lamp.spread * std::sqrt((static_cast<float>(k) + 0.5f) / kRays),
                    turn = 2.39996f * static_cast<float>(k);
        const Point way = (key + out * (std::cos(turn) * u + std::sin(turn) * v)).normalized();
        free += first_hit(bed, from, way, -1).sphere < 0;
    }
    return static_cast<double>(free) / kRays;
}

// One ball is near the wall, and its shadow has a narrow rim. The other is so far from it that it nowhere
// hides the whole lamp.
TEST(WallLight, AShadowEndsWhereTheLampIsSeen) {
    const std::vector<ViewSphere> bed = {{-1, 0.5f, 17, 1}, {-6.5f, 6, 12.5f, 0.3f}};
    Lamp lamp;
    lamp.occlusion = false;
    const Lit lit(bed, {back_wall()}, lamp, 1);
    const double falls = lamp.key * -lamp.to_key[2], ambient = 0.5 * (lamp.sky + lamp.ground);
    const double open = lit.share(kWidth - 40, 20);  // where neither ball is in the way
    EXPECT_NEAR(lamp_seen(bed, seen_on_back_wall(kWidth - 40, 20), lamp), 1, 1e-9);
    double worst = 0, sum = 0, darkest = 1;
    int dark = 0, walls = 0;
    for (int y = 30; y < kHeight - 30; y += 2)
        for (int x = 40; x < kWidth - 40; x += 2) {
            if (!lit.shows_wall(x, y)) continue;
            const double seen = lamp_seen(bed, seen_on_back_wall(x, y), lamp);
            const double expected = open * std::sqrt((ambient + falls * seen) / (ambient + falls));
            worst = std::max(worst, std::abs(lit.share(x, y) - expected));
            sum += std::abs(lit.share(x, y) - expected);
            darkest = std::min(darkest, lit.share(x, y));
            dark += seen < 0.5, ++walls;
        }
    EXPECT_GT(dark, 40);
    EXPECT_LT(darkest, 0.8 * open);
    EXPECT_LT(worst, 0.03);
    EXPECT_LT(sum / walls, 0.001);
}

// A ball lies on a floor. At the distance d from its foot it takes r^2 h / (d^2 + h^2)^1.5 of the light from
// all around, where h is the height of its centre, which is r.
TEST(WallLight, TheFootOfABallTakesTheLightThatItCovers) {
    const std::vector<ViewSphere> bed = {{0, -2, 14, 1}};
    Lamp lamp = even_lamp();
    lamp.key = 0;
    const Lit lit(bed, {floor_face()}, lamp, 1);
    int near = 0;
    for (int y = kHeight / 2; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float v = kSight.slope_y(static_cast<float>(y) + 0.5f);
            const double z = -3 / v, u = kSight.slope_x(static_cast<float>(x) + 0.5f) * z;
            if (!lit.shows_wall(x, y) || z < 8.5 || z > 19.5 || std::abs(u) > 8.5) continue;
            const double d2 = u * u + (z - 14) * (z - 14);
            const double taken = 1 / std::pow(d2 + 1, 1.5);
            near += taken > 0.5;
            EXPECT_NEAR(std::pow(lit.share(x, y), 2), std::max(1 - taken, 0.09), 0.055) << u << ' ' << z;
        }
    EXPECT_GT(near, 30);
}

// Beside a long wall of height h, a floor loses (1 - d / root(d^2 + h^2)) / 2 of the light from all around,
// and gets a quarter of this back.
TEST(WallLight, WallsDarkenEachOtherWhereTheyMeet) {
    const std::vector<ViewSphere> aside = {{0, 30, 60, 1}};
    Lamp lamp = even_lamp();
    lamp.key = 0;
    constexpr float kReach = 2.5f;
    const Lit lit(aside, {back_wall(), floor_face()}, lamp, 1, kReach);
    for (int y = kHeight / 2; y < kHeight; ++y) {
        const double z = -3 / kSight.slope_y(static_cast<float>(y) + 0.5f), d = 20 - z;
        if (d < 0.1 || z < 8.5) continue;
        const double taken = 0.75 * 0.5 * (1 - d / std::hypot(d, kReach));
        EXPECT_NEAR(lit.share(kWidth / 2, y), std::sqrt(1 - taken), 0.004) << d;
    }
    const Lit alone(aside, {floor_face()}, lamp, 1, kReach);
    EXPECT_EQ(alone.light.row(kHeight - 20)[kWidth / 2], 255);
}

TEST(WallLight, IsTheSameForAnyNumberOfThreads) {
    const std::vector<ViewSphere> bed = loose_bed(300, {0.5f, 0.3f}, 6);
    const std::vector<WallFace> faces = {back_wall(), floor_face()};
    const Lit once(bed, faces, {}, 1);
    int dark = 0;
    for (const int threads : {1, 2, 3}) {
        const Lit again(bed, faces, {}, threads);
        for (int y = 0; y < kHeight; ++y) {
            ASSERT_TRUE(std::equal(once.light.row(y), once.light.row(y) + kWidth, again.light.row(y))) << y;
            dark += static_cast<int>(std::count_if(once.light.row(y), once.light.row(y) + kWidth,
                                                   [](std::uint8_t share) { return share < 150; }));
        }
    }
    EXPECT_GT(dark, 100);
}

// A solid face that is painted later hides the wall behind it, which then has no shadow there.
TEST(WallLight, IsNotSeenThroughASolidFace) {
    const std::vector<ViewSphere> bed = {{-1, 0.5f, 18, 1}};
    WallFace screen{{{0, -7, 15}, {9, -7, 15}, {9, 7, 15}, {0, 7, 15}}, 1, false};
    const Lit bare(bed, {back_wall()}, {}, 1), screened(bed, {back_wall(), screen}, {}, 1);
    const int x = kWidth / 2 + 5, y = kHeight / 2 + 3;
    EXPECT_LT(bare.light.row(y)[x], 230);
    EXPECT_EQ(screened.light.row(y)[x], 255);
}

// What a film without a background shows through stays as clear as it was.
TEST(WallLight, LeavesAlphaAsItWas) {
    FilmedScene scene = wedge();
    scene.film.transparent = true;
    const Shot frame = frame_of({{{0, 0, 0.02}}});
    const auto drawn = [&](bool light) {
        scene.film.look.shadows = scene.film.look.occlusion = light;
        Renderer renderer(scene, 1);
        return renderer.draw(frame, "", 0);
    };
    const Picture dark = drawn(true), plain = drawn(false);
    int darker = 0;
    for (std::size_t i = 0; i < dark.rgba.size(); i += 4) {
        ASSERT_EQ(dark.rgba[i + 3], plain.rgba[i + 3]);
        darker += dark.rgba[i] + 5 < plain.rgba[i];
    }
    EXPECT_GT(darker, 100);
}

}  // namespace
}  // namespace grainreel::test
