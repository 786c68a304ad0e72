// Tests of how high the grains get, by formula.
#include "engine/plan/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"

namespace grainreel {
namespace {

constexpr double pi = std::numbers::pi;

// 500 grains of 4 mm in a box of 40 x 20 mm.
FilmedScene box() {
    FilmedScene scene;
    Species grains;
    grains.name = "grains";
    grains.count = 500;
    grains.diameter = {SizeSpread::Kind::fixed, 0.004, 0.004, 0.004, 0};
    scene.species = {grains};
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 0.02;
    scene.container.depth = 0.02;
    scene.container.height = 0.2;
    scene.drive.present = true;
    scene.drive.frequency = 15;
    scene.drive.amplitude = 0.004;
    return scene;
}

double bed() {
    return 500 * pi / 6 * std::pow(0.004, 3) / 0.55 / (0.04 * 0.02);
}

// The flight of a ball on a plate that moves as a sin(w t), computed step by step. The ball leaves where the
// plate falls faster than the ball would.
double highest_of_a_ball(double amplitude, double w) {
    const double g = 9.81, step = 1e-6 / w;
    double highest = 0, height = 0, speed = 0;
    bool flies = false;
    for (double t = 0; t * w < pi; t += step) {
        flies = flies || -amplitude * w * w * std::sin(w * t) < -g;
        if (flies) {
            speed -= g * step;
            height += speed * step;
        } else {
            height = amplitude * std::sin(w * t);
            speed = amplitude * w * std::cos(w * t);
        }
        highest = std::max(highest, height);
    }
    return highest;
}

TEST(Reach, IsTheBedAtRestItsStrokeAndTheFlightOfATop) {
    const FilmedScene scene = box();
    EXPECT_NEAR(*resting_top(scene), bed(), 1e-12);
    const double speed = 1.6 * 0.004 * 2 * pi * 15;
    EXPECT_NEAR(*estimated_reach(scene), bed() + 0.004 + speed * speed / (2 * 9.81), 1e-12);
    // The lowest grains of the bed, which the plate throws only once, do not get as high.
    EXPECT_GT(*estimated_reach(scene), bed() + highest_of_a_ball(0.004, 2 * pi * 15));
}

// The flight's speed divided by that of the plate, for a box of so many of the grains above.
double throw_of(int grains, double restitution) {
    FilmedScene scene = box();
    scene.species[0].count = grains;
    PairContact pair;
    pair.restitution = restitution;
    scene.contact.grain = scene.contact.wall = {pair};
    const double flight = *estimated_reach(scene) - *resting_top(scene) - 0.004;
    return std::sqrt(2 * 9.81 * flight) / (0.004 * 2 * pi * 15);
}

// Hits add up in few layers, the more so where little is lost; the measured speeds of a layer are in the
// header.
TEST(Reach, OfFewLayersIsHigherThanThatOfADeepBed) {
    const int layer = 53;  // grains that fill one diameter at a solid fraction of 0.55
    EXPECT_NEAR(throw_of(layer, 0.9), 1.8 * 1.9 / std::sqrt(1.7 - 0.81), 0.02);
    EXPECT_GT(throw_of(layer, 0.9), 3.5);
    EXPECT_GT(throw_of(layer, 0.7), 2.7);
    EXPECT_GT(throw_of(layer, 0.5), 2.2);
    EXPECT_NEAR(throw_of(2 * layer, 0.9), throw_of(layer, 0.9) / std::sqrt(2.0), 0.01);
    EXPECT_GT(throw_of(2 * layer, 0.7), 1.9);
    for (const int deep : {6, 10}) EXPECT_NEAR(throw_of(deep * layer, 0.9), 1.6, 1e-9);
    EXPECT_NEAR(throw_of(1, 0.1), 1.6, 1e-9);  // a ball that hardly bounces
}

TEST(Reach, OfABedShakenSidewaysHasNoStrokeUpwards) {
    FilmedScene upright = box(), sideways = box();
    sideways.drive.direction = Vec3(0, 1, 0);
    EXPECT_NEAR(*estimated_reach(upright) - *estimated_reach(sideways), 0.004, 1e-12);
}

TEST(Reach, OfABedThatStaysOnTheFloorEndsWithItsStroke) {
    FilmedScene scene = box();
    scene.drive.amplitude = 0.001;
    ASSERT_LT(scene.drive.g_level(9.81), 1);
    EXPECT_NEAR(*estimated_reach(scene), bed() + 0.001, 1e-12);
    scene.drive.present = false;
    EXPECT_NEAR(*estimated_reach(scene), bed(), 1e-12);
}

TEST(Reach, OfGrainsPlacedByHandIsTheirFlightUpwards) {
    FilmedScene scene = box();
    scene.drive.present = false;
    scene.species[0].count = 1;
    scene.start.grains = {{0, 0.004, Vec3(0, 0, 0.05), Vec3(0, 0, 1), Vec3(0, 0, 0)}};
    EXPECT_NEAR(*estimated_reach(scene), 0.052 + 1 / (2 * 9.81), 1e-12);
}

TEST(Reach, IsNotGuessedWhereTheGrainsVolumeDoesNotTellIt) {
    FilmedScene empty = box(), weightless = box(), tilted = box(), planes = box();
    empty.container.shape = Container::Shape::none;
    weightless.gravity = {0, 0, 0};
    tilted.gravity = {0, 9.81 * std::sin(0.5), -9.81 * std::cos(0.5)};
    planes.walls = {ScenePlane{}};
    for (const FilmedScene& scene : {empty, weightless, tilted, planes}) {
        EXPECT_FALSE(resting_top(scene));
        EXPECT_FALSE(estimated_reach(scene));
    }
}

}  // namespace
}  // namespace grainreel
