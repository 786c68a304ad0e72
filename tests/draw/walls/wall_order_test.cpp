// Tests of walls that grains reach through, or that have grains on their far side, pixel by pixel against
// rays.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "render/picture/base/picture.hpp"
#include "render/picture/grains/spheres.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct RayOfSight {
    Vec3 from, along;  // m; of any length
};
RayOfSight ray(const View& view, double x, double y) {
    const double u = (x - 0.5 * view.port.width) / view.focal, v = (0.5 * view.port.height - y) / view.focal;
    if (view.orthographic) return {view.eye + u * view.right + v * view.up, view.forward};
    return {view.eye, view.forward + u * view.right + v * view.up};
}

double meet(const RayOfSight& ray, const Ball& ball) {
    const Vec3 from = ray.from - ball.at;
    const double a = ray.along.squaredNorm(), b = from.dot(ray.along),
                 c = from.squaredNorm() - ball.radius * ball.radius;
    return b * b < a * c ? kFar : (-b - std::sqrt(b * b - a * c)) / a;
}
double meet(const RayOfSight& ray, const ScenePlane& wall) {
    return wall.normal.dot(wall.point - ray.from) / wall.normal.dot(ray.along);
}

// A plane without a container that leans towards the eye or away from it, and a grain in its middle.
FilmedScene leaning_wall(double field_of_view, const Vec3& normal) {
    FilmedScene scene = wedge(960, 540);
    scene.container.shape = Container::Shape::none;
    scene.drive.present = false;
    scene.film.camera.field_of_view = field_of_view;
    scene.film.words = WordPlace::gutters;
    scene.film.camera.azimuth = 20;
    scene.film.camera.elevation = 10;
    if (field_of_view > 0) {  // keeps the camera in its place when the wall is taken away
        scene.film.camera.target = Vec3(0, 0, 0.05);
        scene.film.camera.position = Vec3(0.2, 0.08, 0.09);
    }
    scene.film.look.style = FilmLook::Style::flat;  // no shine on black grains
    scene.film.look.occlusion = scene.film.look.shadows = false;
    add_species(scene, {"black", 1, 0.01, {0, 0, 0}});
    scene.start.grains.resize(2);  // the wall is drawn as far as these grains
    scene.start.grains[0].position = Vec3(-0.05, -0.05, 0);
    scene.start.grains[1].position = Vec3(0.05, 0.05, 0.1);
    ScenePlane wall;
    wall.point = Vec3(0, 0, 0.05);
    wall.normal = normal.normalized();
    scene.walls = {wall};
    return scene;
}
const Ball kThrough{{-0.009, 0.002, 0.052}, 0.02, 2};

// Share of a pixel's points whose line of sight meets `seen`. It is compared with the picture.
double share_of(const View& view, int x, int y, const std::function<bool(const RayOfSight&)>& seen) {
    constexpr int kFine = 8;
    int hits = 0;
    for (int i = 0; i < kFine; ++i)
        for (int j = 0; j < kFine; ++j) hits += seen(ray(view, x + (i + 0.5) / kFine, y + (j + 0.5) / kFine));
    return hits / double{kFine * kFine};
}

void expect_cut_by_the_wall(const FilmedScene& scene, const std::function<bool(const RayOfSight&)>& seen) {
    const View view = view_of(scene);
    Renderer renderer(scene, 2);
    const Picture empty = renderer.draw(frame_of({}), "");
    const Picture picture = renderer.draw(frame_of({kThrough}), "");
    double wrong = 0, covered = 0, worst = 0;
    for (int y = 0; y < view.port.height; ++y)
        for (int x = 0; x < view.port.width; ++x) {
            const double expected = share_of(view, x, y, seen);
            const double before = empty.pixel(x + view.port.x, y + view.port.y)[1];
            const double shown = 1 - picture.pixel(x + view.port.x, y + view.port.y)[1] / before;
            covered += expected;
            wrong += shown - expected;
            worst = std::max(worst, std::abs(shown - expected));
        }
    ASSERT_GT(covered, 2000);
    EXPECT_LT(worst, 0.26);  // of a pixel for which eight points stand
    EXPECT_LT(std::abs(wrong), 0.003 * covered);
}

TEST(WallOrder, AWallHidesAllThatIsBehindItAndNoMore) {
    for (const double field_of_view : {0.0, 40.0}) {
        const FilmedScene scene = leaning_wall(field_of_view, {1, 0.3, 0.4});
        ASSERT_TRUE(view_of(scene).faces(scene.walls[0].point, scene.walls[0].normal));
        expect_cut_by_the_wall(
            scene, [&](const RayOfSight& ray) { return meet(ray, kThrough) < meet(ray, scene.walls[0]); });
    }
}

TEST(WallOrder, AWallHidesWhatACutLeaves) {
    FilmedScene scene = leaning_wall(30, {1, 0.3, 0.4});
    scene.film.look.cut.present = true;
    scene.film.look.cut.normal = Vec3(0, 0, 1);
    scene.film.look.cut.at = 0.06;
    expect_cut_by_the_wall(scene, [&](const RayOfSight& ray) {
        const double top = (0.06 - ray.from.z()) / ray.along.z();  // grains lie from there on
        const RayOfSight back{ray.from, -ray.along};
        const double enter = meet(ray, kThrough), leave = -meet(back, kThrough);
        return enter < kFar && leave > top && std::max(enter, top) < meet(ray, scene.walls[0]);
    });
}

TEST(WallOrder, GlassTintsOnlyWhatIsBehindIt) {
    FilmedScene scene = leaning_wall(40, {-1, 0.3, -0.4});
    ASSERT_FALSE(view_of(scene).faces(scene.walls[0].point, scene.walls[0].normal));
    const View view = view_of(scene);
    Renderer with(scene, 1);
    const Picture glass = with.draw(frame_of({}), ""), picture = with.draw(frame_of({kThrough}), "");
    const ScenePlane wall = scene.walls[0];
    scene.walls.clear();
    Renderer without(scene, 1);
    const Picture plain = without.draw(frame_of({}), ""), bare = without.draw(frame_of({kThrough}), "");
    const double solid = make_palette(scene.film.background).solid.green * 255, strength = 0.05;
    int tinted = 0, clear = 0;
    for (int y = 0; y < view.port.height; ++y)
        for (int x = 0; x < view.port.width; ++x) {
            const int px = x + view.port.x, py = y + view.port.y;
            const auto seen = [&](const RayOfSight& r) { return meet(r, kThrough) < kFar; };
            const auto nearer = [&](const RayOfSight& r) { return meet(r, kThrough) < meet(r, wall); };
            const double grain = share_of(view, x, y, seen), before = share_of(view, x, y, nearer);
            if (grain < 1 || (before > 0 && before < 1)) continue;
            const double own = bare.pixel(px, py)[1];
            ++(before > 0 ? clear : tinted);
            ASSERT_NEAR(picture.pixel(px, py)[1], before > 0 ? own : own + strength * (solid - own), 1)
                << x << ", " << y;
        }
    EXPECT_GT(tinted, 500);
    EXPECT_GT(clear, 1000);
}

TEST(WallOrder, MarksStayOverGrainsThatComeThroughGlass) {
    const auto ring = [](FilmedScene scene) {
        const View view = view_of(scene);
        const Picture plain = Renderer(scene, 1).draw(frame_of({kThrough}), "");
        scene.film.shows.highlighted = {0};
        return changed(plain, Renderer(scene, 1).draw(frame_of({kThrough}), ""), view.port, 60);
    };
    FilmedScene scene = leaning_wall(40, {-1, 0.3, -0.4});
    const Extent through = ring(scene);
    scene.walls.clear();
    const Extent bare = ring(scene);
    EXPECT_GT(bare.count, 200);
    EXPECT_NEAR(through.count, bare.count, 0.02 * bare.count);
    EXPECT_NEAR(through.left, bare.left, 1);
    EXPECT_NEAR(through.bottom, bare.bottom, 1);
}

TEST(WallOrder, AGrainUnderTheFloorOrBehindASolidWallIsNotSeen) {
    FilmedScene scene = wedge(640, 360);
    scene.film.camera.azimuth = 25;
    scene.film.camera.elevation = 25;
    for (const double field_of_view : {0.0, 30.0}) {
        scene.film.camera.field_of_view = field_of_view;
        Renderer renderer(scene, 1);
        const Picture empty = renderer.draw(frame_of({}), "");
        const View view = view_of(scene);
        EXPECT_EQ(changed(empty, renderer.draw(frame_of({{{0, 0, -0.006}, 0.002}}), ""), view.port, 1).count,
                  0);
        EXPECT_EQ(
            changed(empty, renderer.draw(frame_of({{{-0.012, -0.08, 0.12}, 0.003}}), ""), view.port, 1).count,
            0);
        EXPECT_GT(changed(empty, renderer.draw(frame_of({{{0, 0, 0.006}, 0.002}}), ""), view.port, 1).count,
                  20);
    }
}

TEST(WallOrder, GrainsInsideAreLeftAlone) {
    FilmedScene scene = wedge(640, 360);
    for (const double azimuth : {0.0, 30.0, 75.0}) {
        scene.film.camera.azimuth = azimuth;
        const View view = view_of(scene);
        ContainerShapes shapes;
        const State frame = frame_of({{{0.0195, 0, 0.003}, 0.003},
                                      {{-0.017, 0.03, 0.003}, 0.003},
                                      {{0.0, scene.container.half_width - 0.003, 0.13}, 0.003}});
        draw_container(scene, {view, view, false}, frame, make_palette(scene.film.background), 360, shapes);
        Team team(1);
        SpherePainter painter(scene, view.port.width, view.port.height, team, false);
        painter.take(view, frame);
        painter.find_visible();
        painter.find_order(view, shapes);
        EXPECT_TRUE(painter.wall_pixels().empty()) << azimuth;
    }
}

}  // namespace
}  // namespace grainreel::test
