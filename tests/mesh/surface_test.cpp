#include <gmock/gmock.h>
#include <algorithm>

#include <random>

#include "tests/mesh/shapes.hpp"

namespace grainreel {
namespace {

using Turn = Neighbour::Turn;

class Dice {
  public:
    explicit Dice(unsigned seed) : random_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    Vec3 place(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

  private:
    std::mt19937 random_;
};

Surface bare(TriangleMesh mesh) {
    return Surface(std::move(mesh), {}, "");
}

using Long3 = Eigen::Matrix<long double, 3, 1>;

// To the nearest of the sides, in 80 bits.
double distance_to_sides(const Surface& surface, std::int32_t t, const Vec3& point) {
    const Long3 p = point.cast<long double>();
    long double least = 1e300L;
    for (int k = 0; k < 3; ++k) {
        const Long3 begin = surface.corner(t, k).cast<long double>();
        const Long3 side = surface.corner(t, (k + 1) % 3).cast<long double>() - begin;
        const long double s = std::clamp((p - begin).dot(side) / side.dot(side), 0.0L, 1.0L);
        least = std::min(least, (p - begin - s * side).norm());
    }
    return static_cast<double>(least);
}

// To the triangle: inside of it, by barycentric coordinates, that to the plane.
double distance_to(const Surface& surface, std::int32_t t, const Vec3& point) {
    Long3 corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = surface.corner(t, k).cast<long double>();
    const Long3 ab = corner[1] - corner[0], ac = corner[2] - corner[0],
                ap = point.cast<long double>() - corner[0];
    const long double aa = ab.dot(ab), bb = ab.dot(ac), cc = ac.dot(ac), d = ap.dot(ab), e = ap.dot(ac);
    const long double v = (cc * d - bb * e) / (aa * cc - bb * bb),
                      w = (aa * e - bb * d) / (aa * cc - bb * bb);
    if (v >= 0 && w >= 0 && v + w <= 1) return static_cast<double>((ap - v * ab - w * ac).norm());
    return distance_to_sides(surface, t, point);
}

TEST(SurfaceNearest, FeaturesOfATriangle) {
    TriangleMesh mesh;
    shapes::add_triangle(mesh, {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    const Surface surface = bare(mesh);
    const struct {
        Vec3 point, at;
        Feature feature;
    } cases[] = {{{1, 1, 2}, {1, 1, 0}, Feature::face},     {{1, 1, -2}, {1, 1, 0}, Feature::face},
                 {{2, -1, 1}, {2, 0, 0}, Feature::edge0},   {{5, 4.25, 0}, {2.6, 1.05, 0}, Feature::edge1},
                 {{-2, 1, 1}, {0, 1, 0}, Feature::edge2},   {{-1, -2, 1}, {0, 0, 0}, Feature::corner0},
                 {{6, -1, 0}, {4, 0, 0}, Feature::corner1}, {{-1, 5, 0}, {0, 3, 0}, Feature::corner2},
                 {{0, 0, 3}, {0, 0, 0}, Feature::face}};
    for (const auto& c : cases) {
        const NearestPoint found = surface.nearest(0, c.point);
        EXPECT_LT((found.at - c.at).norm(), 1e-14) << c.point.transpose();
        EXPECT_EQ(found.feature, c.feature) << c.point.transpose();
        EXPECT_NEAR(found.squared, (c.point - c.at).squaredNorm(), 1e-13);
    }
}

// The room to move is the height over the nearest edge. Any move by less leaves the nearest point on the
// face, and a move by a little more straight across that edge does not.
TEST(SurfaceNearest, StaysOnTheFaceAsLongAsItSays) {
    TriangleMesh mesh;
    shapes::add_triangle(mesh, {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    const Surface surface = bare(mesh);
    EXPECT_NEAR(surface.stays_on_face(0, {1, 0.5, 2}), 0.5, 1e-8);
    EXPECT_LT(surface.stays_on_face(0, {1, 0.5, -7}), 0.5);
    EXPECT_NEAR(surface.stays_on_face(0, {0.25, 1, 2}), 0.25, 1e-8);
    EXPECT_NEAR(surface.stays_on_face(0, {1.5, 1.5, 0}), (12 - 4.5 - 6) / 5, 1e-8);
    EXPECT_LT(surface.stays_on_face(0, {-0.1, 1, 1}), 0);
    EXPECT_LE(surface.stays_on_face(0, {2, 0, 1}), 0);
    Dice dice(11);
    for (int k = 0; k < 300; ++k) {
        TriangleMesh any;
        shapes::add_triangle(any, dice.place(1), dice.place(1), dice.place(k % 3 ? 1 : 1e-3));
        const Surface one = bare(any);
        const Vec3 middle = (one.corner(0, 0) + one.corner(0, 1) + one.corner(0, 2)) / 3;
        const Vec3 from = middle + dice.between(-1, 1) * one.normal(0);
        const double stays = one.stays_on_face(0, from);
        for (int turn = 0; turn < 20; ++turn) {
            const Vec3 way = (1 - 1e-9) * stays * dice.place(1).normalized();
            EXPECT_EQ(one.nearest(0, from + way).feature, Feature::face) << k;
        }
    }
}

TEST(SurfaceNearest, TheFootOnALevelTriangleIsExact) {
    TriangleMesh mesh;
    shapes::add_triangle(mesh, {-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0});
    const Surface surface = bare(mesh);
    const Vec3 point(0.0123, -0.0456, 0.0049);
    EXPECT_EQ(surface.nearest(0, point).at, Vec3(0.0123, -0.0456, 0));
    EXPECT_EQ(surface.nearest(0, point).squared, 0.0049 * 0.0049);
}

// Down to a millionth of a millionth of their length.
TEST(SurfaceNearest, SlenderTrianglesAreRight) {
    Dice dice(1);
    for (int i = 0; i < 4000; ++i) {
        const double height = std::pow(10.0, -12 * dice.between(0, 1));
        const Vec3 a = dice.place(1), along = dice.place(1).normalized(),
                   aside = along.cross(dice.place(1)).normalized();
        TriangleMesh mesh;
        shapes::add_triangle(mesh, a, a + along, a + dice.between(-0.5, 1.5) * along + height * aside);
        const Surface surface = bare(mesh);
        for (const double far : {1e-3, 1.0}) {
            const Vec3 point = a + dice.between(-0.2, 1.2) * along + far * dice.place(1);
            const NearestPoint found = surface.nearest(0, point);
            // Each place on a slender triangle is nearer than its height to a side.
            EXPECT_NEAR(std::sqrt(found.squared), distance_to_sides(surface, 0, point), height + 1e-15);
            EXPECT_LT(distance_to_sides(surface, 0, found.at), height + 1e-15);
            EXPECT_NEAR((found.at - point).squaredNorm(), found.squared, 1e-14 * far * far + height * far);
            if (height > 1e-6) {
                EXPECT_NEAR(std::sqrt(found.squared), distance_to(surface, 0, point), 1e-12);
            }
        }
    }
}

TEST(SurfaceNearest, NeighboursFindTheSamePointOnTheirEdge) {
    const auto surface = shapes::mended(shapes::turned({{1, 0}, {0.6, 1}}, 9, true, true));
    Dice dice(2);
    int edges = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 point = dice.place(2);
        for (std::int32_t t = 0; t < surface->size(); ++t) {
            const NearestPoint here = surface->nearest(t, point);
            if (here.feature < Feature::edge0 || here.feature > Feature::edge2) continue;
            const int e = static_cast<int>(here.feature) - 1;
            const std::int32_t other = surface->neighbour(t, e).triangle;
            ASSERT_GE(other, 0);
            const NearestPoint there = surface->nearest(other, point);
            if (there.feature < Feature::edge0 || there.feature > Feature::edge2) continue;
            if (surface->neighbour(other, static_cast<int>(there.feature) - 1).triangle != t) continue;
            EXPECT_EQ(here.at, there.at);
            EXPECT_EQ(here.squared, there.squared);
            ++edges;
        }
    }
    EXPECT_GT(edges, 100);
}

TEST(SurfaceTree, FindsWhatALoopOverAllFinds) {
    const auto surface = shapes::mended(
        shapes::sheet(1, 20, [](double x, double y) { return 0.3 * std::sin(4 * x + y * y); }));
    Dice dice(3);
    std::vector<std::int32_t> found{-7};
    for (int i = 0; i < 300; ++i) {
        const Vec3 point = dice.place(1.2);
        const double reach = dice.between(0, 0.5);
        std::vector<std::int32_t> expected{-7};
        std::optional<Surface::Nearest> nearest;
        for (std::int32_t t = 0; t < surface->size(); ++t) {
            const NearestPoint here = surface->nearest(t, point);
            if (here.squared > reach * reach) continue;
            expected.push_back(t);
            if (!nearest || here.squared < nearest->point.squared) nearest = Surface::Nearest{t, here};
        }
        found.resize(1);
        surface->near(point, reach, found);
        EXPECT_EQ(found, expected);
        EXPECT_EQ(surface->any_within(point, reach), expected.size() > 1);
        const auto one = surface->nearest(point, reach);
        ASSERT_EQ(one.has_value(), nearest.has_value());
        if (one) {
            EXPECT_EQ(one->triangle, nearest->triangle);
            EXPECT_EQ(one->point.at, nearest->point.at);
        }
    }
}

TEST(SurfaceTree, OfEqualDistancesTheLowestNumberCounts) {
    const auto surface = shapes::mended(shapes::sheet(1, 8, [](double, double) { return 0.0; }));
    for (std::int32_t t = 0; t < surface->size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Vec3 over = surface->corner(t, k) + Vec3(0, 0, 0.1);
            std::vector<std::int32_t> around;
            surface->near(over, 0.1 * (1 + 1e-9), around);
            ASSERT_TRUE(surface->nearest(over, 1).has_value());
            EXPECT_EQ(surface->nearest(over, 1)->triangle, around.front());
        }
}

TEST(SurfaceTree, NothingIsFoundOnAnEmptyMeshOrBesideIt) {
    const Surface empty = bare({});
    std::vector<std::int32_t> found;
    empty.near({0, 0, 0}, 1e9, found);
    EXPECT_TRUE(found.empty());
    EXPECT_FALSE(empty.nearest({0, 0, 0}, 1e9).has_value());
    EXPECT_FALSE(empty.first_hit({0, 0, 0}, {0, 0, 1}).has_value());
    const auto surface = shapes::mended(shapes::box({0, 0, 0}, {1, 1, 1}));
    EXPECT_FALSE(surface->any_within({0.5, 0.5, 2}, 0.999));
    EXPECT_FALSE(surface->any_within({std::nan(""), 0, 0}, 1));
}

// A roof of two planes over y, with an angle between them; seen from above.
Turn turn_of_roof(double angle, bool from_below) {
    const double half = 0.5 * angle;
    TriangleMesh mesh;
    const Vec3 left(0, -std::cos(half), -std::sin(half)), right(0, std::cos(half), -std::sin(half));
    shapes::add_triangle(mesh, {-1, 0, 0}, left, {1, 0, 0});
    shapes::add_triangle(mesh, {1, 0, 0}, right, {-1, 0, 0});
    const auto surface = shapes::mended(from_below ? shapes::inside_out(mesh) : mesh);
    for (int e = 0; e < 3; ++e)
        if (surface->neighbour(0, e).triangle == 1) return surface->neighbour(0, e).turn;
    ADD_FAILURE() << "no neighbours";
    return Turn::flat;
}

TEST(SurfaceNeighbours, TurnsByAngle) {
    for (const bool below : {false, true}) {
        EXPECT_EQ(turn_of_roof(0, below), Turn::flat);
        EXPECT_EQ(turn_of_roof(0.9e-6, below), Turn::flat);
        EXPECT_EQ(turn_of_roof(1.1e-6, below), Turn::smooth);
        EXPECT_EQ(turn_of_roof(-1.1e-6, below), Turn::smooth);
        EXPECT_EQ(turn_of_roof(kSmoothAngle * (1 - 1e-9), below), Turn::smooth);
        EXPECT_EQ(turn_of_roof(kSmoothAngle * (1 + 1e-9), below), below ? Turn::concave : Turn::convex);
        EXPECT_EQ(turn_of_roof(-kSmoothAngle * (1 + 1e-9), below), below ? Turn::convex : Turn::concave);
        EXPECT_EQ(turn_of_roof(2.5, below), below ? Turn::concave : Turn::convex);
        EXPECT_EQ(turn_of_roof(-2.5, below), below ? Turn::convex : Turn::concave);
    }
}

TEST(SurfaceNeighbours, OpenAndCrowdedEdgesHaveNone) {
    TriangleMesh mesh = shapes::sheet(1, 1, [](double, double) { return 0.0; });
    shapes::add_triangle(mesh, {-1, -1, 0}, {1, 1, 0}, {0, 0, 1});
    const auto surface = shapes::mended(mesh);
    for (std::int32_t t = 0; t < 3; ++t)
        for (int e = 0; e < 3; ++e) EXPECT_EQ(surface->neighbour(t, e).triangle, -1);
}

TEST(SurfaceNeighbours, OfADrumOf36FacetsTheSeamsAreSmoothAndTheRimsAreNot) {
    const auto surface = shapes::mended(shapes::turned({{1, 0}, {1, 1}}, 36, true, true));
    int flat = 0, smooth = 0, convex = 0;
    for (std::int32_t t = 0; t < surface->size(); ++t)
        for (int e = 0; e < 3; ++e) {
            ASSERT_GE(surface->neighbour(t, e).triangle, 0);
            EXPECT_FALSE(surface->neighbour(t, e).flips);
            flat += surface->neighbour(t, e).turn == Turn::flat;
            smooth += surface->neighbour(t, e).turn == Turn::smooth;
            convex += surface->neighbour(t, e).turn == Turn::convex;
        }
    EXPECT_EQ(flat, 2 * (36 + 2 * 36));  // diagonals, and the seams of both fans
    EXPECT_EQ(smooth, 2 * 36);
    EXPECT_EQ(convex, 2 * 2 * 36);
}

TEST(SurfaceSizes, AreasNormalsAndFarthestPlaces) {
    const auto surface = shapes::mended(shapes::box({-1, -2, -3}, {1, 2, 3}));
    double area = 0;
    Vec3 sum(0, 0, 0);
    for (std::int32_t t = 0; t < surface->size(); ++t) {
        area += surface->area(t);
        sum += surface->area(t) * surface->normal(t);
        EXPECT_GT(surface->normal(t).dot(surface->corner(t, 0)), 0);  // outwards
    }
    EXPECT_DOUBLE_EQ(area, 2 * (2 * 4 + 4 * 6 + 6 * 2));
    EXPECT_LT(sum.norm(), 1e-13);
    EXPECT_DOUBLE_EQ(surface->farthest_from({0, 0, 0}), std::sqrt(1.0 + 4 + 9));
    EXPECT_DOUBLE_EQ(surface->farthest_from_axis({1, 0, 7}, {0, 0, 2}), std::sqrt(4.0 + 4));
}

}  // namespace
}  // namespace grainreel
