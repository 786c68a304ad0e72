#include <gmock/gmock.h>

#include <random>

#include "tests/mesh/shapes.hpp"

namespace grainreel {
namespace {

std::vector<Surface::Hit> hits_of(const Surface& surface, const Vec3& from, const Vec3& towards) {
    std::vector<Surface::Hit> hits;
    surface.all_hits(from, (towards - from).normalized(), hits);
    return hits;
}

TEST(SurfaceRays, ThroughABoxInAndOut) {
    const auto surface = shapes::mended(shapes::box({0, 0, 0}, {1, 2, 3}));
    const auto hits = hits_of(*surface, {-2, 0.3, 0.4}, {5, 0.3, 0.4});
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_DOUBLE_EQ(hits[0].distance, 2);
    EXPECT_DOUBLE_EQ(hits[1].distance, 3);
    EXPECT_TRUE(hits[0].front);
    EXPECT_FALSE(hits[1].front);
    const auto first = surface->first_hit({-2, 0.3, 0.4}, {1, 0, 0});
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(first->triangle, hits[0].triangle);
    EXPECT_EQ(first->distance, hits[0].distance);
    EXPECT_TRUE(surface->meets({0.5, 0.5, 0.5}, {0, 0, 1}));
    EXPECT_FALSE(surface->meets({0.5, 0.5, 3.5}, {0, 0, 1}));
    EXPECT_TRUE(surface->meets({-2, 0.3, 0.4}, {1, 0, 0}, 2.001));
    EXPECT_FALSE(surface->meets({-2, 0.3, 0.4}, {1, 0, 0}, 1.999));
    EXPECT_FALSE(surface->first_hit({0.5, 0.5, 3.5}, {1, 0, 0}).has_value());
}

// Each ray from within a closed surface leaves once more than it enters, wherever it goes: here through all
// corners and the middles of all edges, which every second triangle touches.
TEST(SurfaceRays, NoneIsLostOrDoubledAtCornersAndEdges) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> within(-0.3, 0.3);
    for (const auto& surface : {shapes::mended(shapes::box({-1, -1, -1}, {1, 1, 1})),
                                shapes::mended(shapes::turned(
                                    {{0, -1}, {1, -0.5}, {0.8, 0.1}, {1, 0.7}, {0, 1}}, 16, false, false)),
                                shapes::mended(shapes::turned({{1, -1}, {1, 1}}, 64, true, true))})
        for (int i = 0; i < 40; ++i) {
            const Vec3 from = i == 0 ? Vec3(0, 0, 0) : Vec3(within(random), within(random), within(random));
            for (std::int32_t t = 0; t < surface->size(); ++t)
                for (int k = 0; k < 3; ++k)
                    for (const double part : {0.0, 0.5, 0.123}) {
                        const Vec3 towards =
                            (1 - part) * surface->corner(t, k) + part * surface->corner(t, (k + 1) % 3);
                        const auto hits = hits_of(*surface, from, towards);
                        int winding = 0;
                        for (const Surface::Hit& hit : hits) winding += hit.front ? -1 : 1;
                        EXPECT_EQ(winding, 1) << towards.transpose() << " from " << from.transpose();
                        EXPECT_EQ(hits.size() % 2, 1u);
                    }
        }
}

TEST(SurfaceRays, FromOutsideTheyEnterAsOftenAsTheyLeave) {
    const auto surface =
        shapes::mended(shapes::turned({{0, -1}, {1, -0.5}, {0.4, 0.1}, {1, 0.7}, {0, 1}}, 16, false, false));
    std::mt19937 random(8);
    std::uniform_real_distribution<double> around(-1, 1);
    for (int i = 0; i < 300; ++i) {
        Vec3 from(around(random), around(random), around(random));
        from = 3 * from.normalized();
        if (i % 3 == 0) from = Vec3(0, 0, i % 2 ? 3 : -3);  // along the axis, through both tips
        for (const Vec3& vertex : surface->mesh().vertices) {
            int winding = 0;
            for (const Surface::Hit& hit : hits_of(*surface, from, vertex)) winding += hit.front ? -1 : 1;
            EXPECT_EQ(winding, 0) << vertex.transpose();
        }
    }
}

TEST(SurfaceRays, AlongLevelFacesAndThroughALatticeOfASheet) {
    const auto flat = shapes::mended(shapes::sheet(1, 8, [](double, double) { return 0.0; }));
    for (int i = 0; i <= 16; ++i)
        for (int j = 0; j <= 16; ++j) {
            const Vec3 from(-1 + i / 8.0, -1 + j / 8.0, 1);
            const auto hits = hits_of(*flat, from, from - Vec3(0, 0, 5));
            const bool inside = i > 0 && i < 16 && j > 0 && j < 16;
            if (inside) {
                ASSERT_EQ(hits.size(), 1u) << from.transpose();
                EXPECT_DOUBLE_EQ(hits[0].distance, 1);
                EXPECT_TRUE(hits[0].front);
            } else {
                EXPECT_LE(hits.size(), 1u);
            }
        }
    EXPECT_LE(hits_of(*flat, {-3, 0.1, 0}, {3, 0.1, 0}).size() % 2, 1u);  // in the plane: no crash
}

TEST(SurfaceRays, TheFirstIsTheNearestOfAll) {
    const auto surface = shapes::mended(
        shapes::sheet(1, 20, [](double x, double y) { return 0.3 * std::sin(9 * x + y * y); }));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> around(-1.2, 1.2);
    int met = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3 from(around(random), around(random), around(random)),
            to(around(random), around(random), around(random));
        const auto hits = hits_of(*surface, from, to);
        const auto first = surface->first_hit(from, (to - from).normalized());
        ASSERT_EQ(first.has_value(), !hits.empty());
        EXPECT_EQ(surface->meets(from, (to - from).normalized()), !hits.empty());
        if (!first) continue;
        ++met;
        EXPECT_EQ(first->triangle, hits[0].triangle);
        // The crossing lies in the triangle.
        const Vec3 there = from + first->distance * (to - from).normalized();
        EXPECT_LT(surface->nearest(first->triangle, there).squared, 1e-28);
    }
    EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace grainreel
