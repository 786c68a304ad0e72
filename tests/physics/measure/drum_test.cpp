// Tests of containers that turn: how far they turn, how the bed lies in them, and what they give the grains.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/measure/surface/surface_observers.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "tests/physics/measure/bed_by_hand.hpp"

namespace grainreel {
namespace {

using Bed = test::BedByHand;
constexpr double pi = std::numbers::pi;

BodyTurn turn_about(const Vec3& axis, double rate, const Vec3& through = {0, 0, 0}) {
    BodyTurn turn;
    turn.axis = axis;
    turn.rate = rate;
    turn.through = through;
    return turn;
}

// Stacks that stand close together, with tops exactly at top(y).
Grains stacks(const std::function<double(double)>& top) {
    Grains grains;
    for (int j = 0; j <= 400; ++j)
        for (double y = 0.1 * (j - 200), z = top(y) - 0.5; z > 0; z -= 1)
            grains.add(static_cast<std::int32_t>(grains.size()), 0, {0, y, z}, 0.5, 1);
    return grains;
}

// The surface is straight only in the middle third, whose slope counts.
TEST(DrumSurface, IsTheSlopeOfTheMiddleThird) {
    const Grains grains = stacks([](double y) { return 14 + 0.5 * std::clamp(y, -8.0, 8.0); });
    const auto angle = [&](const Vec3& axis, double rate) {
        const auto axes = drum_axes(turn_about(axis, rate), {0, 0, -10});
        return angle_of_repose(grains.place, *axes, 1);
    };
    constexpr double hair = 0.005;  // the tops in a bin are up to a grain's spacing away from its middle
    EXPECT_NEAR(angle({1, 0, 0}, 2), std::atan(0.5), hair);
    EXPECT_NEAR(angle({1, 0, 0}, -2), -std::atan(0.5), hair);
    EXPECT_NEAR(angle({-1, 0, 0}, 2), -std::atan(0.5), hair);
}

// The bed is carried up where the lowest part of the drum goes: at the rate w about x it moves along +y.
TEST(DrumSurface, RisesWhereTheDrumGoes) {
    const BodyTurn turn = turn_about({1, 0, 0}, 2);
    const auto axes = drum_axes(turn, {0, 0, -10});
    ASSERT_TRUE(axes);
    const Vec3 lowest(0, 0, -1);
    EXPECT_GT((turn.rate * turn.axis).cross(lowest).dot(axes->across), 0);
    EXPECT_EQ(axes->up, Vec3(0, 0, 1));
}

TEST(DrumSurface, AnAxisThatStandsHasNone) {
    EXPECT_FALSE(drum_axes(turn_about({0, 0, 1}, 2), {0, 0, -10}));
    EXPECT_FALSE(drum_axes(turn_about({1, 0, 0}, 2), {0, 0, 0}));
    EXPECT_TRUE(drum_axes(turn_about({0, 0, 1}, 2), {0, -10, 0}));  // a cylinder on its side
}

TEST(DrumSurface, FroudeNumber) {
    EXPECT_DOUBLE_EQ(froude_number(2, 0.1, 10), 2 * 2 * 0.1 / 10);
}

TEST(DrumInstrument, CountsRevolutionsOfTheContainer) {
    Bed bed("drum");
    bed.scene.container.shape = Container::Shape::cylinder;
    bed.scene.container.turn = turn_about({0, 0, 1}, -3);
    bed.gravity = {0, -10, 0};
    bed.pose.time = 2;
    EXPECT_NEAR(bed.look(2000, "revolutions"), 3 * 2 / (2 * pi), 1e-12);
    EXPECT_NEAR(bed.look(2000, "froude_number"), 9 * 20.0 / 10, 1e-12);  // half_width is 20
    EXPECT_TRUE(std::isnan(bed.look(2000, "repose_angle_degree")));      // no grains
}

TEST(DrumInstrument, HasNoValueWhereNothingTurns) {
    Bed bed("drum");
    for (const char* column : {"revolutions", "froude_number", "repose_angle_degree"})
        EXPECT_TRUE(std::isnan(bed.look(0, column))) << column;
}

// The corner of a box is farthest from a level axis through its middle.
TEST(TurningBody, HasTheRadiusOfItsFarthestPoint) {
    Scene scene;
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 3;
    scene.container.depth = 10;
    scene.container.height = 8;
    scene.container.turn = turn_about({1, 0, 0}, 1, {0, 0, 4});
    EXPECT_DOUBLE_EQ(turning_body(scene)->radius, 5);
    EXPECT_TRUE(turns_over(scene));
    scene.container.turn->axis = {0, 0, 1};
    EXPECT_FALSE(turns_over(scene));
}

// A mesh alone in space, on which the grains act with a constant force and moment.
struct MeshInSpace {
    Bed bed{"walls"};
    explicit MeshInSpace(const SceneMesh& mesh) {
        bed.scene.container.shape = Container::Shape::none;
        bed.scene.meshes = {mesh};
        bed.scene.meshes[0].name = "drum";
        bed.walls = WallSums{};
        bed.walls->faces.resize(1);
        bed.start();
    }
    // The mean over all steps since the start.
    double after(std::int64_t steps, const std::array<int, 3>& force, const std::array<int, 3>& moment,
                 const char* column) {
        for (std::size_t a = 0; a < 3; ++a) {
            bed.walls->faces[0].force[a] = force[a] * steps;
            bed.walls->faces[0].moment[a] = moment[a] * steps;
        }
        bed.pose.time = 1e-3 * static_cast<double>(steps);
        bed.gather(steps);
        return bed.look(steps, column);
    }
};

SceneMesh turning(const BodyTurn& turn) {
    SceneMesh mesh;
    mesh.turn = turn;
    return mesh;
}

// The grains brake a drum, which turns at 2 rad/s, with 3 N m; it gives them 6 W.
TEST(WallPower, OfADrumIsTorqueTimesRate) {
    MeshInSpace drum(turning(turn_about({0, 1, 0}, 2, {1, 2, 3})));
    EXPECT_NEAR(drum.after(125, {5, 0, 0}, {7, -3, 0}, "drum_torque_N.m"), -3, 1e-12);
    EXPECT_NEAR(drum.bed.look(125, "drum_power_W"), 6, 1e-9);
    EXPECT_NEAR(drum.bed.look(125, "drum_moment_x_N.m"), 7,
                1e-12);  // about a point of the axis, whichever point
}

// While the drum starts its mean rate counts: half of the last rate, because the ramp is symmetric.
TEST(WallPower, OfADrumThatStartsGoesByItsAngle) {
    BodyTurn turn = turn_about({0, 1, 0}, 2);
    turn.over = 0.125;
    MeshInSpace drum(turning(turn));
    EXPECT_NEAR(drum.after(125, {0, 0, 0}, {0, -3, 0}, "drum_power_W"), 3, 1e-9);
}

TEST(WallPower, OfAMeshThatMovesIsForceTimesVelocity) {
    SceneMesh belt;
    belt.velocity = {0.5, 0, 0};
    MeshInSpace drum(belt);
    EXPECT_NEAR(drum.after(125, {-4, 1, 0}, {0, 0, 9}, "drum_power_W"), 2, 1e-9);
}

// The power is the mean since the row before, not since the start.
TEST(WallPower, IsThatOfTheLastRow) {
    MeshInSpace drum(turning(turn_about({0, 1, 0}, 2)));
    drum.after(125, {0, 0, 0}, {0, -3, 0}, "drum_power_W");
    EXPECT_NEAR(drum.after(250, {0, 0, 0}, {0, -2, 0}, "drum_power_W"), 2 * (2 * 250 - 3 * 125) / 125.0,
                1e-9);
}

}  // namespace
}  // namespace grainreel
