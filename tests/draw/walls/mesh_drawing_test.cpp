// Tests of meshes between grains: which hides which, compared with rays; glass, lines along edges, sections,
// and the same picture for any number of threads.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>

#include "engine/mesh/load_mesh.hpp"
#include "render/picture/mesh/mesh_painter.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/sphere_layer.hpp"
#include "tests/draw/support.hpp"
#include "tests/mesh/shapes.hpp"

namespace grainreel::test {
namespace {

using shapes::add_quad;
using shapes::add_triangle;
using shapes::box;

constexpr int kWidth = 320, kHeight = 240;
constexpr double kEdgeAngle = 30 * pi / 180;
constexpr std::uint32_t kWhite = 0xffffffffu;

std::shared_ptr<const MeshShape> shape_of(TriangleMesh mesh, MeshLook look) {
    MeshFacts facts;
    mend(mesh, facts);
    return mesh_shape(Surface(std::move(mesh), facts, ""), kEdgeAngle, look);
}

struct Scenery {
    std::vector<std::shared_ptr<const MeshShape>> shapes;
    std::vector<Ball> balls;
    Cut cut = {};
    double field_of_view = 25;
};

View view_around(double field_of_view) {
    Camera camera;
    camera.azimuth = 25;
    camera.elevation = 20;
    camera.field_of_view = field_of_view;
    const std::vector<Vec3> points = box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}).vertices;
    return fit_view(camera, points, {0, 0, kWidth, kHeight}, 20, kHeight);
}

// The pixels of all layers on white, with black grains and walls of one grey.
std::vector<std::uint32_t> drawn(const Scenery& scenery, int threads) {
    const View view = view_around(scenery.field_of_view);
    const Sight sight{view.orthographic, static_cast<float>(view.focal), 0.5f * kWidth, 0.5f * kHeight};
    Spheres spheres;
    for (const Ball& ball : scenery.balls) {
        const Eigen::Vector3f at = view.to_view(ball.at).cast<float>();
        spheres.spheres.push_back({at.x(), at.y(), at.z(), static_cast<float>(ball.radius)});
        spheres.albedo.push_back({0, 0, 0});
    }
    std::vector<DrawnMesh> meshes;
    for (const auto& shape : scenery.shapes) meshes.push_back({shape, {}, nullptr});
    Lamp lamp;
    lamp.shine = 0;
    Team team(threads);
    MeshProjection projection;
    MeshPainter painter(kWidth, kHeight);
    SphereLayer grains(kWidth, kHeight);
    const MeshPaints paints{{160, 160, 160}, {160, 160, 160}, {200, 40, 40}, Vec3::UnitZ(), 1};
    for (int time = 0; time < 2; ++time) {  // nothing of the first time is left
        const std::vector<DrawnMesh> some = time == 0 ? std::vector<DrawnMesh>() : meshes;
        projection.take(view, sight, scenery.cut, some, paints, team);
        painter.draw_solid(projection, sight, team);
        grains.find_visible(sight, scenery.cut, spheres, team, painter.depth());
        painter.draw_rest(projection, sight, grains.visibility(), {{100, 100, 255}, {0, 160, 0}}, team);
    }
    grains.find_order(sight, scenery.cut, spheres, {}, team);
    grains.find_neighbours(scenery.cut, lamp, spheres, team);
    const Layer& lit = grains.light(sight, scenery.cut, lamp, spheres, team);
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            pixels.push_back(over(painter.before().row(y)[x],
                                  over(lit.row(y)[x], over(painter.behind().row(y)[x], kWhite))));
    return pixels;
}

int channel(std::uint32_t pixel, int c) {
    return static_cast<int>(pixel >> (8 * c) & 255u);
}
// The largest excess of green over red at a point or beside it.
int greenest(const std::vector<std::uint32_t>& pixels, const View& view, const Vec3& point) {
    const Eigen::Vector2i at = view.project(point).cast<int>();
    int most = 0;
    for (int y = at.y() - 1; y <= at.y() + 1; ++y)
        for (int x = at.x() - 1; x <= at.x() + 1; ++x) {
            const std::uint32_t pixel = pixels[static_cast<std::size_t>(y * kWidth + x)];
            most = std::max(most, channel(pixel, 1) - channel(pixel, 0));
        }
    return most;
}

struct Line {
    Vec3 from, along;
};
Line line_of_sight(const View& view, double x, double y) {
    const double u = (x - 0.5 * kWidth) / view.focal, v = (0.5 * kHeight - y) / view.focal;
    if (view.orthographic) return {view.eye + u * view.right + v * view.up, view.forward};
    return {view.eye, view.forward + u * view.right + v * view.up};
}

constexpr double kFar = std::numeric_limits<double>::infinity();
double meet(const Line& line, const Ball& ball) {
    const Vec3 from = line.from - ball.at;
    const double a = line.along.squaredNorm(), b = from.dot(line.along),
                 c = from.squaredNorm() - ball.radius * ball.radius;
    return b * b < a * c ? kFar : (-b - std::sqrt(b * b - a * c)) / a;
}
// The method is that of Moeller and Trumbore 1997.
double meet(const Line& line, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a, p = line.along.cross(v), from = line.from - a, q = from.cross(u);
    const double by = u.dot(p);
    if (by == 0) return kFar;
    const double s = from.dot(p) / by, t = line.along.dot(q) / by;
    return s < 0 || t < 0 || s + t > 1 ? kFar : v.dot(q) / by;
}

enum class Shows { nothing, grain, wall };
Shows shown_along(const Line& line, const Scenery& scenery) {
    double grain = kFar, wall = kFar;
    for (const Ball& ball : scenery.balls) grain = std::min(grain, meet(line, ball));
    for (const auto& shape : scenery.shapes)
        for (const TriangleMesh::Triangle& t : shape->triangles)
            wall = std::min(wall, meet(line, shape->vertices[static_cast<std::size_t>(t[0])],
                                       shape->vertices[static_cast<std::size_t>(t[1])],
                                       shape->vertices[static_cast<std::size_t>(t[2])]));
    if (grain == kFar && wall == kFar) return Shows::nothing;
    return grain < wall ? Shows::grain : Shows::wall;
}

// Loose triangles, each solid from both sides, among grains. Some of the grains reach through them.
Scenery thicket(double field_of_view) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-0.05, 0.05), size(0.006, 0.014);
    Scenery scenery;
    scenery.field_of_view = field_of_view;
    for (int i = 0; i < 12; ++i) {
        TriangleMesh mesh;
        for (int k = 0; k < 3; ++k) mesh.vertices.emplace_back(place(random), place(random), place(random));
        mesh.triangles.push_back({0, 1, 2});
        scenery.shapes.push_back(shape_of(mesh, MeshLook::solid));
    }
    for (int i = 0; i < 60; ++i)
        scenery.balls.push_back({{place(random), place(random), place(random)}, size(random)});
    return scenery;
}

// A pixel whose nine lines of sight agree must show what they meet; lines along edges are left out.
void expect_as_rays_meet(const Scenery& scenery) {
    const std::vector<std::uint32_t> pixels = drawn(scenery, 2);
    const View view = view_around(scenery.field_of_view);
    int compared = 0, wrong = 0;
    std::array<int, 3> seen{};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const Shows middle = shown_along(line_of_sight(view, x + 0.5, y + 0.5), scenery);
            bool alike = true;
            for (const double dx : {-1.0, 0.0, 1.0})
                for (const double dy : {-1.0, 0.0, 1.0})
                    alike = alike &&
                            shown_along(line_of_sight(view, x + 0.5 + dx, y + 0.5 + dy), scenery) == middle;
            const std::uint32_t pixel =
                pixels[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)];
            const bool on_line = channel(pixel, 1) > channel(pixel, 0) + 1;
            if (!alike || on_line) continue;
            ++compared;
            ++seen[static_cast<std::size_t>(middle)];
            const int wanted = middle == Shows::nothing ? 255 : middle == Shows::grain ? 0 : 160;
            wrong += std::abs(channel(pixel, 0) - wanted) > 2;
        }
    EXPECT_GT(compared, kWidth * kHeight / 2);
    for (const int count : seen) EXPECT_GT(count, 2000);
    EXPECT_LE(wrong, compared / 2000);
}

TEST(MeshDrawing, HidesAndIsHiddenAsRaysSay) {
    expect_as_rays_meet(thicket(25));
}

TEST(MeshDrawing, HidesAndIsHiddenAsRaysSayWithoutPerspective) {
    expect_as_rays_meet(thicket(0));
}

TEST(MeshDrawing, IsTheSamePictureForAnyNumberOfThreads) {
    Scenery scenery = thicket(25);
    scenery.shapes.push_back(
        shape_of(box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}, false), MeshLook::vessel));
    const std::vector<std::uint32_t> one = drawn(scenery, 1);
    for (const int threads : {2, 3}) EXPECT_EQ(drawn(scenery, threads), one) << threads;
}

// In an open box around grains, the near walls tint the grains by a twentieth and the far ones are behind
// them.
TEST(MeshDrawing, AVesselHidesNoGrain) {
    Scenery scenery;
    for (const double y : {-0.02, 0.0, 0.02}) scenery.balls.push_back({{0, y, -0.03}, 0.012});
    const std::vector<std::uint32_t> bare = drawn(scenery, 1);
    scenery.shapes = {shape_of(box({-0.04, -0.04, -0.045}, {0.04, 0.04, 0.04}, false), MeshLook::vessel)};
    const std::vector<std::uint32_t> inside = drawn(scenery, 1);
    int grain = 0, walls = 0;
    for (std::size_t i = 0; i < bare.size(); ++i) {
        if (bare[i] == kWhite) walls += channel(inside[i], 0) < 200;
        if (channel(bare[i], 0) != 0) continue;
        ++grain;
        // Glass of 100, 100, 255 lies over black, two panes at most.
        EXPECT_LE(channel(inside[i], 0), 100 * 0.12 + 1);
        EXPECT_LE(channel(inside[i], 2), 255 * 0.12 + 1);
    }
    EXPECT_GT(grain, 2000);
    EXPECT_GT(walls, 10000);  // the far walls are solid
}

// Nine edges of a cube are visible and three are not.
TEST(MeshDrawing, LinesRunAlongTheEdgesInSight) {
    const Vec3 low(-0.03, -0.03, -0.03), high(0.03, 0.03, 0.03);
    Scenery scenery;
    scenery.shapes = {shape_of(box(low, high), MeshLook::solid)};
    const std::vector<std::uint32_t> pixels = drawn(scenery, 1);
    const View view = view_around(25);
    int seen = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 4; ++k) {
            Vec3 a = low;
            a[(axis + 1) % 3] = k & 1 ? high.x() : low.x();
            a[(axis + 2) % 3] = k & 2 ? high.x() : low.x();
            Vec3 middle = a;
            middle[axis] = 0;
            const bool visible =
                view.faces(middle, Vec3(middle[0] != 0 && axis != 0 ? middle[0] : 0, 0, 0)) ||
                view.faces(middle, Vec3(0, axis != 1 ? middle[1] : 0, 0)) ||
                view.faces(middle, Vec3(0, 0, axis != 2 ? middle[2] : 0));
            const bool on_line = greenest(pixels, view, middle) > 80;
            EXPECT_EQ(on_line, visible) << middle.transpose();
            seen += on_line;
        }
    EXPECT_EQ(seen, 9);
}

// A cube that is cut through its middle shows a square of the section's colour.
TEST(MeshDrawing, ACutShowsMaterialFlat) {
    Scenery scenery;
    scenery.field_of_view = 0;
    scenery.shapes = {shape_of(box({-0.03, -0.03, -0.03}, {0.03, 0.03, 0.03}), MeshLook::solid)};
    const View view = view_around(0);
    const Vec3 kept(-1, 0, 0);
    scenery.cut.planes = 1;
    scenery.cut.plane[0] = {static_cast<float>(kept.dot(view.right)), static_cast<float>(kept.dot(view.up)),
                            static_cast<float>(kept.dot(view.forward)),
                            static_cast<float>(-kept.dot(view.eye))};
    const std::vector<std::uint32_t> pixels = drawn(scenery, 1);
    int red = 0;
    for (const std::uint32_t pixel : pixels)
        red += channel(pixel, 0) > channel(pixel, 1) + 100 && channel(pixel, 0) > 150;
    const double side = 0.06 * view.focal, expected = side * side * std::abs(view.forward.x());
    EXPECT_NEAR(red, expected, 8 * side);  // lines around the square cover half a pixel of it
    EXPECT_LT(red, expected);
}

using Face = MeshShape::Face;

TEST(MeshSides, AnOpenBoxIsSolidInsideAndGlassOutside) {
    const auto shape = shape_of(box({0, 0, 0}, {0.1, 0.1, 0.1}, false), MeshLook::automatic);
    for (std::size_t t = 0; t < shape->sides.size(); ++t) {
        const TriangleMesh::Triangle& corners = shape->triangles[t];
        const bool outwards = shape->normals[t].dot(shape->vertices[static_cast<std::size_t>(corners[0])] -
                                                    Vec3(0.05, 0.05, 0.05)) > 0;
        EXPECT_EQ(outwards ? shape->sides[t].front : shape->sides[t].back, Face::glass);
        EXPECT_EQ(outwards ? shape->sides[t].back : shape->sides[t].front, Face::solid);
    }
}

TEST(MeshSides, AClosedBodyIsSolidUnlessItIsTheVessel) {
    const TriangleMesh cube = box({0, 0, 0}, {0.1, 0.1, 0.1});
    const auto insert = shape_of(cube, MeshLook::automatic), vessel = shape_of(cube, MeshLook::vessel);
    for (const MeshShape::Sides& sides : insert->sides)
        EXPECT_TRUE(sides.front == Face::solid && sides.back == Face::unseen);
    for (const MeshShape::Sides& sides : vessel->sides)
        EXPECT_TRUE(sides.front == Face::glass && sides.back == Face::solid);
}

// A drum about z with eight bars along its wall, a quarter of its radius high. It is one closed sheet that is
// dented from outside.
TriangleMesh drum_with_bars(double radius, double half_length) {
    std::vector<Vec3> ring;
    const auto add = [&](double r, double degrees) {
        ring.push_back({r * std::cos(degrees * pi / 180), r * std::sin(degrees * pi / 180), 0});
    };
    for (int bar = 0; bar < 8; ++bar) {
        add(radius, 45 * bar - 5), add(0.75 * radius, 45 * bar - 2.5);
        add(0.75 * radius, 45 * bar + 2.5), add(radius, 45 * bar + 5);
        for (int i = 1; i < 7; ++i) add(radius, 45 * bar + 5 + 5 * i);
    }
    const Vec3 up(0, 0, half_length);
    TriangleMesh mesh;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 &here = ring[i], &next = ring[(i + 1) % ring.size()];
        add_quad(mesh, here - up, next - up, next + up, here + up);
        add_triangle(mesh, up, here + up, next + up);
        add_triangle(mesh, -up, next - up, here - up);
    }
    return mesh;
}

TEST(MeshSides, AVesselWithDeepBarsIsGlassAllRoundAndABarThatFloatsInItIsSolid) {
    TriangleMesh mesh = drum_with_bars(0.1, 0.03);
    const auto drum = mesh.triangles.size();
    const TriangleMesh bar = box({-0.01, -0.02, -0.01}, {0.01, 0.02, 0.01});
    shapes::add(mesh, bar);
    const auto shape = shape_of(mesh, MeshLook::vessel);
    ASSERT_EQ(shape->sides.size(), drum + bar.triangles.size());
    for (std::size_t t = 0; t < drum; ++t)
        ASSERT_TRUE(shape->sides[t].front == Face::glass && shape->sides[t].back == Face::solid) << t;
    for (std::size_t t = drum; t < shape->sides.size(); ++t)
        ASSERT_TRUE(shape->sides[t].front == Face::solid && shape->sides[t].back == Face::unseen) << t;
}

TEST(MeshSides, AFlatPlateIsSolidFromBothSides) {
    TriangleMesh plate;
    add_quad(plate, {0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0});
    const auto shape = shape_of(plate, MeshLook::automatic);
    for (const MeshShape::Sides& sides : shape->sides)
        EXPECT_TRUE(sides.front == Face::solid && sides.back == Face::solid);
}

// The box has walls of 5 mm and is open above.
TEST(MeshSides, WallsWithAThicknessAreGlassOutsideAndSolidWithinAndAtTheRim) {
    TriangleMesh shell = box({0, 0, 0}, {0.1, 0.1, 0.1}, false);
    shapes::add(shell, shapes::inside_out(box({0.005, 0.005, 0.005}, {0.095, 0.095, 0.1}, false)));
    const double a = 0, b = 0.1, c = 0.005, d = 0.095, z = 0.1;
    add_quad(shell, {a, a, z}, {b, a, z}, {d, c, z}, {c, c, z});
    add_quad(shell, {b, a, z}, {b, b, z}, {d, d, z}, {d, c, z});
    add_quad(shell, {b, b, z}, {a, b, z}, {c, d, z}, {d, d, z});
    add_quad(shell, {a, b, z}, {a, a, z}, {c, c, z}, {c, d, z});
    for (const MeshLook look : {MeshLook::automatic, MeshLook::vessel}) {
        const auto shape = shape_of(shell, look);
        for (std::size_t t = 0; t < shape->sides.size(); ++t) {
            Vec3 middle = Vec3::Zero();
            for (const std::int32_t v : shape->triangles[t])
                middle += shape->vertices[static_cast<std::size_t>(v)] / 3;
            const bool outside = middle.z() < 1e-9 || std::min({middle.x(), middle.y(), 0.1 - middle.x(),
                                                                0.1 - middle.y()}) < 1e-9;
            EXPECT_EQ(shape->sides[t].front, outside ? Face::glass : Face::solid) << middle.transpose();
            EXPECT_EQ(shape->sides[t].back, Face::unseen);
        }
    }
}

// A strip that winds up around an axis. Its triangles fold up and down by up to 40 degrees.
TEST(MeshShapes, ATwistedStripHasNoEdgesButItsBorders) {
    TriangleMesh strip;
    constexpr int kSteps = 24;
    const auto at = [](double radius, int i) {
        const double angle = 2 * pi * i / kSteps;
        return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.08 * i / kSteps);
    };
    for (int i = 0; i < 3 * kSteps; ++i)
        add_quad(strip, at(0.01, i), at(0.04, i), at(0.04, i + 1), at(0.01, i + 1));
    MeshFacts facts;
    mend(strip, facts);
    const Surface surface(strip, facts, "");
    double most = 0;
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int e = 0; e < 3; ++e)
            if (surface.neighbour(t, e).triangle >= 0)
                most = std::max(most, turn_of(surface, t, surface.neighbour(t, e)));
    ASSERT_GT(most, kEdgeAngle);
    int inside = 0, borders = 0;
    const auto shape = mesh_shape(surface, kEdgeAngle, MeshLook::solid);
    for (const MeshShape::Edge& edge : shape->edges)
        if (edge.feature) ++(edge.right < 0 ? borders : inside);
    EXPECT_LE(inside, 2);  // the two ends have no neighbour to fold back
    EXPECT_EQ(borders, 2 * 3 * kSteps + 2);
}

TEST(Upright, TheAxesOfAViewAreThoseOfItsUpwardDirection) {
    for (const Vec3& up : {Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, 0, -1), Vec3(1, 2, 2).normalized()})
        for (const double azimuth : {0.0, 70.0}) {
            const View view = looking(azimuth, 20, up);
            EXPECT_NEAR(view.right.dot(up), 0, 1e-12);
            EXPECT_NEAR(view.up.dot(up), std::cos(20 * pi / 180), 1e-12);
            EXPECT_NEAR((view.forward.cross(view.up) - view.right).norm(), 0, 1e-12);
        }
    EXPECT_LT((looking(0, 0, {0, 1, 0}).forward - Vec3(0, 0, -1)).norm(), 1e-12);
    EXPECT_LT((looking(30, 10, {0, 0, 1}).forward - looking(30, 10).forward).norm(), 1e-12);
}

}  // namespace
}  // namespace grainreel::test
