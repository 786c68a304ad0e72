// Tests of arrows that show forces on walls.
#include "render/picture/marks/force_marks.hpp"

#include <gtest/gtest.h>

#include "engine/measure/measures.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

TEST(PointOfAction, IsWhereAForceWithItsMomentCrossesTheWall) {
    Face wall;
    wall.point = {0, 0.05, 0};
    wall.normal = Vec3(0, -1, 0.3).normalized();
    const Vec3 along = Vec3::UnitX(), up = wall.normal.cross(along);
    // There are contacts at two places of the wall; parallel forces act at the mean of their places.
    const Vec3 one = wall.point + 0.01 * along + 0.02 * up, other = wall.point - 0.004 * along + 0.06 * up;
    const Vec3 force(0.1, 1, -0.4);
    const Vec3 moment = one.cross(force) + other.cross(2 * force);
    const std::optional<Vec3> acts = point_of_action(wall, 3 * force, moment);
    ASSERT_TRUE(acts);
    EXPECT_LT((*acts - (one + 2 * other) / 3).norm(), 1e-12);
    EXPECT_FALSE(point_of_action(wall, along, moment)) << "runs along the wall";
    EXPECT_FALSE(point_of_action(wall, Vec3::Zero(), Vec3::Zero()));
}

TEST(WallForces, ArrowEndsWhereTheForceActs) {
    FilmedScene scene = wedge();
    scene.film.camera.field_of_view = 0;
    scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    scene.film.shows.wall_forces = {true, 4};
    const auto table = std::make_shared<MeasureTable>(
        std::vector<std::string>{"time_s", "floor_force_x_N", "floor_force_y_N", "floor_force_z_N",
                                 "floor_moment_x_N.m", "floor_moment_y_N.m", "floor_moment_z_N.m"});
    const Vec3 force(0, 0, -2), acts(0, 0.012, 0), moved(0, 0, 0.003);
    const Vec3 moment = acts.cross(force);
    table->add({0, force.x(), force.y(), force.z(), moment.x(), moment.y(), moment.z()});
    Frame frame = frame_of({});
    frame.container().place = frame.floor().place = moved;
    const View view = view_of(scene);
    const auto drawn = [&](std::size_t rows) {
        frame.measures = table;
        frame.measure_rows = rows;
        Shapes shapes;
        WallForceMarks(scene, make_palette({1, 1, 1})).draw(view, frame, shapes);
        return extent_of_vertices(shapes);
    };
    EXPECT_EQ(drawn(0).count, 0) << "no row yet";
    const Extent seen = drawn(1);
    ASSERT_GT(seen.count, 0);
    const Pixel tip = view.project(moved + acts);
    EXPECT_NEAR(0.5 * (seen.left + seen.right), tip.x(), 1);
    EXPECT_NEAR(seen.bottom, tip.y(), 6);  // the border and its mitre
    // The force is half of the scale's force: an eighth of the container's width.
    EXPECT_NEAR(seen.bottom - seen.top, 0.15 / 8 * view.focal, 8);
    table->add({1, 0, 0, 2 * force.z(), 2 * moment.x(), 0, 0});  // the next row has twice the force
    const Extent next = drawn(2);
    EXPECT_NEAR(next.bottom - next.top, 0.15 / 4 * view.focal, 8);
}

}  // namespace
}  // namespace grainreel::test
