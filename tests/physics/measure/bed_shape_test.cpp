// Tests of solid fraction, side walls and intruder on beds with simple numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/numbers.hpp"
#include "engine/measure/bed/bed_formulas.hpp"
#include "engine/measure/segregation/segregation.hpp"

namespace grainreel {
namespace {

Scene box_scene(double width, double depth, double height) {
    Scene scene;
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 0.5 * width;
    scene.container.depth = depth;
    scene.container.height = height;
    scene.species.resize(2);
    scene.species[0].diameter.mean = 1;
    scene.species[1].diameter.mean = 3;
    return scene;
}

// Grains of diameter 1 on sites of a cubic lattice, which fill a box from the height `floor` upwards.
Grains cubic_bed(int width, int depth, int height, double floor) {
    Grains grains;
    for (int k = 0; k < height; ++k)
        for (int j = 0; j < width; ++j)
            for (int i = 0; i < depth; ++i)
                grains.add(static_cast<std::int32_t>(grains.size()), 0,
                           {i + 0.5 - 0.5 * depth, j + 0.5 - 0.5 * width, floor + k + 0.5}, 0.5, 1);
    return grains;
}

// A cubic lattice has pi/6, also if the middle of a layer is the limit.
TEST(SolidFraction, OfACubicLatticeIsPiOverSix) {
    const Scene scene = box_scene(5, 5, 9);
    const Grains grains = cubic_bed(5, 5, 5, 0.7);
    for (const double height : {5.0, 4.5, 2.5, 1.0})
        EXPECT_NEAR(solid_fraction(scene.container, grains, 0.7, 0.7 + height), std::numbers::pi / 6, 1e-12);
    EXPECT_NEAR(solid_fraction(scene.container, grains, 0.7, 0.7 + 8), 5.0 / 8 * std::numbers::pi / 6, 1e-12);
}

// A cap of height h of a sphere of radius r has the volume pi h^2 (3 r - h) / 3; here r = 1/2 and h = 1/4.
TEST(SolidFraction, CountsACapBelowTheTop) {
    const Scene scene = box_scene(1, 1, 9);
    const Grains grain = cubic_bed(1, 1, 1, 0);
    const double cap = std::numbers::pi / 16 * (1.5 - 0.25) / 3;
    EXPECT_NEAR(solid_fraction(scene.container, grain, 0, 0.25), cap / 0.25, 1e-12);
}

// A ball of radius 1 lies in a cylinder of radius 3, and in a wedge between slants of 45 degrees. The wedge
// has a floor of half-width 2 and the area 4 h + h^2 up to the height h.
TEST(SolidFraction, IsOverTheRoomOfTheContainersShape) {
    Scene scene = box_scene(6, 5, 9);
    scene.container.shape = Container::Shape::cylinder;
    Grains ball;
    ball.add(0, 0, {0, 0, 1}, 1, 1);
    const double volume = 4 * std::numbers::pi / 3;
    EXPECT_NEAR(solid_fraction(scene.container, ball, 0, 4), volume / (std::numbers::pi * 9 * 4), 1e-12);
    scene.container.shape = Container::Shape::wedge;
    scene.container.half_width = 8;
    scene.container.half_angle = std::numbers::pi / 4;
    scene.container.slant_height = 6;
    EXPECT_NEAR(solid_fraction(scene.container, ball, 0, 3), volume / (5 * (4 * 3 + 3 * 3)), 1e-12);
}

TEST(SolidFraction, EndsAtTheRim) {
    const Scene scene = box_scene(5, 5, 9);
    const Grains grains = cubic_bed(5, 5, 9, 0);
    EXPECT_NEAR(solid_fraction(scene.container, grains, 0, 12), std::numbers::pi / 6, 1e-12);
}

TEST(SolidFraction, IsUndefinedInEmptySpaceAndUnderTheFloor) {
    Scene scene = box_scene(5, 5, 9);
    const Grains grains = cubic_bed(5, 5, 5, 0);
    EXPECT_TRUE(std::isnan(solid_fraction(scene.container, grains, 1, 1)));
    scene.container.shape = Container::Shape::none;
    EXPECT_TRUE(std::isnan(solid_fraction(scene.container, grains, 0, 1)));
}

// The smallest mean diameter is 1: a grain of radius 2 is beside a wall that is nearer to its centre than 3.
TEST(SideWalls, AreLeftAndRightButNotFrontAndBack) {
    const SideWalls walls(box_scene(20, 4, 20));
    EXPECT_EQ(walls.side_of({{0, -7.1, 5}, 2}, {}), Side::left);
    EXPECT_EQ(walls.side_of({{0, 7.1, 5}, 2}, {}), Side::right);
    EXPECT_EQ(walls.side_of({{0, 6.9, 5}, 2}, {}), Side::none);
    EXPECT_EQ(walls.side_of({{1.5, 0, 2}, 2}, {}), Side::none);  // it is beside front and floor
}

TEST(SideWalls, MoveWithTheContainer) {
    Scene scene = box_scene(20, 4, 20);
    scene.drive.present = true;
    const SideWalls walls(scene);
    EXPECT_EQ(walls.side_of({{0, 7.1, 5}, 2}, {{0, 1, 0}, {0, 0, 0}, 0}), Side::none);
    EXPECT_EQ(walls.side_of({{0, 8.1, 5}, 2}, {{0, 1, 0}, {0, 0, 0}, 0}), Side::right);
}

// At the height z, a slant of 45 degrees from the edge of a floor of half-width w has the distance (w + z -
// |y|) cos 45.
TEST(SideWalls, AreSlantsOfAWedge) {
    Scene scene = box_scene(20, 4, 20);
    scene.container.shape = Container::Shape::wedge;
    scene.container.half_angle = std::numbers::pi / 4;
    scene.container.slant_height = 8;  // floor of half-width 2
    const SideWalls walls(scene);
    const double reach = 3 * std::numbers::sqrt2;  // along y
    EXPECT_EQ(walls.side_of({{0, 2 + 4 - 0.99 * reach, 4}, 2}, {}), Side::right);
    EXPECT_EQ(walls.side_of({{0, 2 + 4 - 1.01 * reach, 4}, 2}, {}), Side::none);
}

TEST(SideWalls, OfACylinderGoRound) {
    Scene scene = box_scene(20, 20, 20);
    scene.container.shape = Container::Shape::cylinder;
    const SideWalls walls(scene);
    EXPECT_EQ(walls.side_of({{7.1, -0.1, 5}, 2}, {}), Side::left);
    EXPECT_EQ(walls.side_of({{7.1, 0.1, 5}, 2}, {}), Side::right);
    EXPECT_EQ(walls.side_of({{6.9, 0.1, 5}, 2}, {}), Side::none);
}

// A bed of ten layers has a grain of radius 3/2 whose top is at a known height; the floor is at 0.25.
TEST(Intruder, IsAsHighAsItsTopOverTheSurface) {
    const Scene scene = box_scene(12, 12, 40);
    Grains grains = cubic_bed(12, 12, 10, 0.25);
    grains.add(5000, 1, {0, 0, 0.25 + 1.5}, 1.5, 1);
    const auto intruder = find_intruder(scene, grains);
    ASSERT_TRUE(intruder);
    EXPECT_EQ(grains.id[*intruder], 5000);
    for (const double top : {3.0, 5.0, 10.0, 12.0}) {
        grains.place[*intruder].position.z() = 0.25 + top - 1.5;
        EXPECT_NEAR(intruder_height(scene, grains, *intruder, 0.25), top / 10, 1e-12);
    }
}

// The surface around the intruder counts: the bed is six layers high there, and ten elsewhere.
TEST(Intruder, GoesByTheSurfaceAroundIt) {
    const Scene scene = box_scene(30, 12, 40);
    Grains grains;
    for (const Place& p : cubic_bed(30, 12, 10, 0).place)
        if (p.position.y() > 0 || p.position.z() < 6)
            grains.add(static_cast<std::int32_t>(grains.size()), 0, p.position, p.radius, 1);
    grains.add(5000, 1, {0, -8, 6 - 1.5}, 1.5, 1);
    EXPECT_NEAR(intruder_height(scene, grains, grains.size() - 1, 0), 1, 1e-12);
}

// A bed is six layers high in its middle and ten elsewhere along x; the second bed is the same, moved by half
// a period.
TEST(Intruder, SeesTheSurfaceAcrossAPeriodicDepth) {
    Scene scene = box_scene(12, 12, 40);
    scene.container.periodic_depth = true;
    const auto level = [&](double moved) {
        Grains grains;
        for (const Place& p : cubic_bed(12, 12, 10, 0).place) {
            if (std::abs(p.position.x()) < 2 && p.position.z() > 6) continue;
            const double x = nearest_image(p.position.x() + moved, 12);
            grains.add(static_cast<std::int32_t>(grains.size()), 0, {x, p.position.y(), p.position.z()}, 0.5,
                       1);
        }
        grains.add(5000, 1, {nearest_image(0.3 + moved, 12), 0, 4}, 1.5, 1);
        return intruder_height(scene, grains, grains.size() - 1, 0);
    };
    EXPECT_NEAR(level(6), level(0), 1e-12);
}

TEST(Intruder, IsOneGrainOfTheLargestSpecies) {
    const Scene scene = box_scene(12, 12, 40);
    Grains grains = cubic_bed(3, 3, 3, 0);
    EXPECT_FALSE(find_intruder(scene, grains));
    grains.add(100, 1, {0, 0, 8}, 1.5, 1);
    EXPECT_TRUE(find_intruder(scene, grains));
    grains.add(101, 1, {0, 0, 12}, 1.5, 1);
    EXPECT_FALSE(find_intruder(scene, grains));
}

}  // namespace
}  // namespace grainreel
