// Tests of arrows that show forces on walls.
#include "render/picture/base/shot.hpp"
#include "render/picture/marks/force_marks.hpp"

#include <gtest/gtest.h>

#include "engine/measure/measures.hpp"
#include "engine/state/body.hpp"
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

// A contact pushes outwards and rubs along the wall; the line of its force leaves the cylinder there.
TEST(PointOfAction, IsWhereAForceLeavesACylinder) {
    Face wall;
    wall.kind = Face::Kind::cylinder;
    wall.radius = 0.03;
    for (const double angle : {0.3, 2.0, 4.5}) {
        const Vec3 out(std::cos(angle), std::sin(angle), 0), round(-out.y(), out.x(), 0);
        const Vec3 at = wall.radius * out + Vec3(0, 0, 0.012),
                   force = 2 * out + 0.9 * round - Vec3(0, 0, 0.4);
        const std::optional<Vec3> acts = point_of_action(wall, force, at.cross(force));
        ASSERT_TRUE(acts);
        EXPECT_LT((*acts - at).norm(), 1e-12);
    }
    EXPECT_FALSE(point_of_action(wall, Vec3::UnitZ(), Vec3::Zero())) << "runs along the wall";
    EXPECT_FALSE(point_of_action(wall, Vec3::UnitX(), Vec3(0, 0, -2 * wall.radius))) << "beside the cylinder";
}

// The arrow of a force on one wall that acts at a place. The moment counts about `about`.
Extent arrow_of(const FilmedScene& scene, const std::string& wall, const Vec3& force, const Vec3& acts,
                const Vec3& about, const BodyPose& pose) {
    std::vector<std::string> columns{"time_s"};
    for (const char* axis : {"x", "y", "z"}) columns.push_back(wall + "_force_" + axis + "_N");
    for (const char* axis : {"x", "y", "z"}) columns.push_back(wall + "_moment_" + axis + "_N.m");
    const auto table = std::make_shared<MeasureTable>(columns);
    const Vec3 moment = (acts - about).cross(force);
    table->add({0, force.x(), force.y(), force.z(), moment.x(), moment.y(), moment.z()});
    Shot frame = frame_of({});
    frame.container() = frame.floor() = pose;
    frame.measures = table;
    frame.measure_rows = 1;
    Shapes shapes;
    WallForceMarks(scene, make_palette({1, 1, 1})).draw(view_of(scene), frame, shapes);
    return extent_of_vertices(shapes);
}

// A box that shakes and has turned by 90 degrees about x. Its left wall then is below, and the grains press
// it down.
TEST(WallForces, OfAContainerThatTurnsActWhereTheWallIsNow) {
    FilmedScene scene = wedge();
    scene.container.shape = Container::Shape::box;
    scene.container.turn = BodyTurn{.axis = {1, 0, 0}, .through = {0, 0.01, 0.05}, .rate = pi / 2};
    scene.film.camera.field_of_view = scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    scene.film.shows.wall_forces = {true, 4};
    const BodyPose pose =
        bodies_of(scene)[kContainerBody].at(DrivePose{.offset = Vec3(0, 0.001, 0.002), .time = 1});
    const Vec3 acts = pose.moved({0.01, -scene.container.half_width, 0.07});
    const Extent seen =
        arrow_of(scene, "left_wall", {0, 0, -2}, acts, pose.moved(scene.container.turn->through), pose);
    ASSERT_GT(seen.count, 0);
    const Pixel tip = view_of(scene).project(acts);
    EXPECT_NEAR(0.5 * (seen.left + seen.right), tip.x(), 1);
    EXPECT_NEAR(seen.bottom, tip.y(), 6);  // the border and its mitre
}

// The bed of a drum on its side lies on the wall where gravity points. In a cylinder that stands it touches
// the wall all around.
TEST(WallForces, OfADrumOnItsSideActUnderTheBed) {
    FilmedScene scene = wedge();
    scene.container.shape = Container::Shape::cylinder;
    scene.container.turn = BodyTurn{.rate = 1};
    scene.film.camera.field_of_view = scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    scene.film.shows.wall_forces = {true, 4};
    const BodyPose pose = bodies_of(scene)[kContainerBody].at(DrivePose{.time = 2});
    const Vec3 acts(0, -scene.container.half_width, 0.05), force(0, -2, 0);
    const View view = view_of(scene);
    scene.gravity = {0, -9.81, 0};
    const Extent lying = arrow_of(scene, "wall", force, acts, {0, 0, 0}, pose);
    ASSERT_GT(lying.count, 0);
    EXPECT_NEAR(lying.left, view.project(acts).x(), 6);  // the border and its mitre
    EXPECT_NEAR(0.5 * (lying.top + lying.bottom), view.project(acts).y(), 1);
    scene.gravity = {0, 0, -9.81};
    const Extent standing = arrow_of(scene, "wall", force, acts, {0, 0, 0}, pose);
    EXPECT_NEAR(standing.left, view.project({0, scene.container.half_width, 0}).x(), 6);
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
    Shot frame = frame_of({});
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
