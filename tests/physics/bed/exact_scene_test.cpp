// Tests of scenes with grains and planes placed by hand, run as a user runs them.
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells_only;

State end_of(const Scene& scene) {
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 1);
    simulation.pack();
    simulation.advance(plan.steps);
    return simulation.frame();
}

Scene scene_of(const std::string& text, const std::vector<std::string>& sets = {}) {
    return read_scene_text(text, "test.toml", with_tested_precision(sets));
}

// There are two balls and a plane that rises at w. The first ball hits the second, which stands still; then
// the plane hits both. Without friction they get 0.1 and 0.9 of the speed along y, and (1 + e) w upwards
// each.
TEST(ExactScene, TwoCollisionsAsOnPaper) {
    const State end = end_of(scene_of(exact_text, {"contact.friction=0", "run.steps_per_contact=400"}));
    ASSERT_EQ(end.size(), 2u);
    EXPECT_NEAR(end.velocity[0].y(), 0.1 * 0.5, 1e-4);
    EXPECT_NEAR(end.velocity[1].y(), 0.9 * 0.5, 1e-4);
    EXPECT_NEAR(end.velocity[0].z(), 1.8 * 0.1, 2e-4);
    EXPECT_NEAR(end.velocity[1].z(), 1.8 * 0.1, 2e-4);
    EXPECT_EQ(end.velocity[0].x(), 0);
    EXPECT_NEAR(end.spin[0].z(), 60, 1e-12) << "nothing rubs";
}

TEST(ExactScene, GrainsKeepTheirNumbersAndSizes) {
    const std::string text =
        with(with(exact_text, "diameter = \"4 mm\"", "diameter = { min = 0.003, max = 0.005 }"),
             "species = \"ball\"", "diameter = 0.0031");
    const State start = [&] {
        const Scene scene = scene_of(text);
        const Plan plan = make_plan(scene);
        SimulatedBed simulation(scene, plan, 1);
        simulation.pack();
        return simulation.frame();
    }();
    EXPECT_EQ(start.id, (std::vector<std::int32_t>{0, 1}));
    EXPECT_EQ(start.radius[0], 0.002);
    EXPECT_EQ(start.radius[1], 0.00155);
    EXPECT_EQ(start.position[1], Vec3(0, 0.01, 0));
    EXPECT_EQ(start.spin[0], Vec3(0, 0, 60));
    EXPECT_EQ(start.velocity[0], Vec3(0, 0.5, 0));
}

std::string complaint(const std::string& text) {
    try {
        end_of(scene_of(text));
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

TEST(ExactScene, GrainsInEachOtherOrBehindAPlaneAreMistakes) {
    EXPECT_THAT(complaint(with(exact_text, "[0, \"1 cm\", 0]", "[0, \"3 mm\", 0]")),
                tells_only({"test.toml:15:3", "grains 0 and 1", "0.50 of the smaller", "move"}));
    EXPECT_THAT(complaint(with(exact_text, "[0, \"1 cm\", 0]", "[0, \"1 cm\", \"-4 mm\"]")),
                tells_only({"test.toml:19:1", "beyond the wall 1", "move"}));
}

// One plane follows the drive and stands beside one that does not move.
TEST(ExactScene, PlanesFollowTheDriveWhereAsked) {
    const std::string text = with(exact_text, "velocity = [0, 0, \"10 cm/s\"]", "moves = true") +
                             "[drive]\nfrequency = 50\namplitude = 0.002\nramp = 0\n";
    const State moved = end_of(scene_of(text, {"contact.friction=0"}));
    EXPECT_GT(moved.velocity[0].z(), 0.1) << "the plane, 1 mm below, has hit it";
    const State still = end_of(scene_of(with(text, "moves = true", "moves = false"), {"contact.friction=0"}));
    EXPECT_EQ(still.velocity[0].z(), 0);
}

}  // namespace
}  // namespace grainreel
