// Tests of the health check: it stops a run that is no longer physical, says where, and stops no other run.
#include "engine/measure/health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::HasSubstr;

class HealthCheck : public testing::Test {
  protected:
    void SetUp() override {
        limits.clock.step = w.plan.clock.step;
        limits.species = {"big"};
        w.around.faces = {floor_face()};
        w.grains.add(0, 0, Vec3(0, 0, 3 * kRadius), kRadius, kDensity);
        w.grains.add(1, 0, Vec3(3 * kRadius, 0, 3 * kRadius), kRadius, kDensity);
    }
    std::string complaint() {
        if (!w.loop) w.start();
        try {
            check_state(limits, w.around, w.grains, *w.loop, 1234);
        } catch (const RunError& error) {
            return error.what();
        }
        return "";
    }

    HandMadeBed w = make_world(walton_braun_pair(0.9, 0.3), 1e-6);
    HealthLimits limits;
};

TEST_F(HealthCheck, SaysNothingOfASoundState) {
    w.grains.place[1].position.x() = 2 * kRadius - 0.32 * kRadius;
    EXPECT_EQ(complaint(), "");
}

TEST_F(HealthCheck, StopsAtAnOverlapOfAThirdOfARadius) {
    w.grains.place[1].position.x() = 2 * kRadius - 0.35 * kRadius;
    const std::string said = complaint();
    EXPECT_THAT(said, HasSubstr("step 1234"));
    EXPECT_THAT(said, tells({"grain 0 (big)", "(0, 0, 0.006) m", "grain 1", "0.35"}));
    EXPECT_THAT(said, tells({"larger contact.stiffness", "smaller run.step"}));
}

TEST_F(HealthCheck, StopsAtAnOverlapWithAWall) {
    w.grains.place[1].position.z() = 0.6 * kRadius;
    EXPECT_THAT(complaint(), HasSubstr("overlaps the floor by 0.40"));
}

// Twice what the plan expects, or a tenth of a radius, or, where it expects more than that, what it expects.
TEST(HealthLimitsTest, TellFromTwiceThePlanOn) {
    const auto told = [](double planned) {
        HealthLimits limits;
        limits.planned = planned;
        return limits.told();
    };
    EXPECT_DOUBLE_EQ(told(0.02), 0.04);
    EXPECT_DOUBLE_EQ(told(0.08), 0.1);
    EXPECT_DOUBLE_EQ(told(0.2), 0.2);
}

TEST_F(HealthCheck, FindsTheContactThatOverlapsMost) {
    limits.planned = 0.04;
    w.grains.place[1].position = Vec3(0.7 * kRadius, 0, 0.8 * kRadius);
    w.grains.place[0].position = Vec3(0.7 * kRadius, 1.9 * kRadius, 0.95 * kRadius);
    w.start();
    const DeepestContact deepest = check_state(limits, w.around, w.grains, *w.loop, 1234);
    EXPECT_NEAR(deepest.share, 0.2, 1e-12);
    EXPECT_EQ(deepest.grain, 1);
    EXPECT_EQ(deepest.other, "the floor");
    EXPECT_EQ(deepest.step, 1234);
    EXPECT_THAT(overlap_text(limits, deepest), tells({"grain 1 (big)", "the floor", "0.2 of",
                                                      "0.04 are planned", "contact.wall.stiffness"}));
    limits.planned = 0.11;
    EXPECT_NE(overlap_text(limits, deepest), "");
    limits.planned = 0.25;
    EXPECT_EQ(overlap_text(limits, deepest), "");
}

// A stiffer floor is no help where a wall presses; so the wall is named.
TEST_F(HealthCheck, NamesTheWallThatPresses) {
    limits.planned = 0.04;
    Face plate = floor_face();
    plate.name = "plate";
    plate.point = Vec3(0, 0, 1.7 * kRadius);
    plate.normal = Vec3(0, 0, -1);
    plate.body.number = 2;
    plate.body.velocity = Vec3(0, 0, -0.01);
    w.around.faces.push_back(plate);
    w.grains.place[0].position = Vec3(10 * kRadius, 0, 0.8 * kRadius);
    w.grains.place[1].position = Vec3(0, 0, 0.8 * kRadius);
    w.start();
    const DeepestContact deepest = check_state(limits, w.around, w.grains, *w.loop, 0);
    EXPECT_EQ(deepest.other, "the floor");
    EXPECT_THAT(overlap_text(limits, deepest), tells({"the plate moves", "let it stop", "diameter before"}));
}

// A fast wall that hits a free grain does not press it; there a larger stiffness helps.
TEST_F(HealthCheck, BlamesTheStiffnessWhereAWallHitsAFreeGrain) {
    limits.planned = 0.04;
    Face plate = floor_face();
    plate.name = "plate";
    plate.point = Vec3(0, 0, 3.7 * kRadius);
    plate.normal = Vec3(0, 0, -1);
    plate.body.number = 2;
    plate.body.velocity = Vec3(0, 0, -10);
    w.around.faces.push_back(plate);
    w.grains.place[0].position = Vec3(10 * kRadius, 0, 2 * kRadius);
    w.grains.place[1].position = Vec3(0, 0, 2.9 * kRadius);
    w.start();
    const DeepestContact deepest = check_state(limits, w.around, w.grains, *w.loop, 0);
    EXPECT_EQ(deepest.other, "the plate");
    EXPECT_THAT(overlap_text(limits, deepest), tells({"0.2 of", "contact.wall.stiffness"}));
}

TEST_F(HealthCheck, StopsAtWhatIsNoNumber) {
    w.start();
    w.grains.motion[w.index_of(1)].velocity.y() = NAN;
    EXPECT_THAT(complaint(), HasSubstr("grain 1 (big)"));
    EXPECT_THAT(complaint(), HasSubstr("is no longer a number"));
}

TEST_F(HealthCheck, StopsAtAGrainBehindAWall) {
    w.grains.place[1].position.z() = -1.1 * kRadius;
    EXPECT_THAT(complaint(), HasSubstr("went through the floor"));
}

TEST_F(HealthCheck, LetsWallsGiveEnergyAndStopsAtMore) {
    EnergyWatch watch;
    const auto check = [&](double energy, double work) {
        watch.check(energy, work, 10, 1e-3, limits, w.grains, 100);
    };
    check(1.0, 0.0);
    check(2.5, 1.6);  // 1.6 J of work, 0.1 J lost
    EXPECT_THROW(check(2.7, 1.6), RunError);
    EXPECT_NO_THROW(check(2.55, 1.6));
    w.grains.motion[0].velocity.x() = std::sqrt(2 * 3.0 / sphere_mass());  // 3 J of motion
    EXPECT_NO_THROW(check(2.7, 1.6));
}

// Nothing moves any more and no energy was exchanged; what is left is rounding of sums that were 1 J.
TEST_F(HealthCheck, TakesRoundingForNoGain) {
    EnergyWatch watch;
    const auto check = [&](double energy, double through) {
        watch.check(energy, 0, through, 0, limits, w.grains, 100);
    };
    check(0.1, 1);
    EXPECT_NO_THROW(check(0.1 + 1e-12, 0.2));
    EXPECT_THROW(check(0.1 + 1e-6, 0.2), RunError);
}

// Two balls fall through an outlet and touch nothing on their way. When the last one has left, no grain is
// there.
TEST(Health, FallsWithoutContactsEndInGoodOrder) {
    for (const char* height : {"0.041", "0.05", "0.0234", "0.035", "0.0333"}) {
        const std::string text = std::string(R"([[species]]
name = "ball"
diameter = "10 mm"
density = "2.5 g/cm3"
[contact]
stiffness = 1000
[container]
shape = "box"
width = "100 mm"
depth = "60 mm"
height = "60 mm"
top = "open"
outlet = { width = "60 mm", exit_depth = "300 mm" }
[[grain]]
position = [0, 0, 0.03]
[[grain]]
position = [0.012, 0, )") + height +
                                 "]\n[run]\nduration = \"0.3 s\"\n";
        const Scene scene = read_scene_text(text, "fall.toml", {}, measurable_in);
        const Plan plan = make_plan(scene);
        SimulatedBed simulation(scene, plan, 1);
        EXPECT_NO_THROW(simulation.advance(plan.steps)) << height;
        EXPECT_EQ(simulation.grains(), 0u);
    }
}

}  // namespace
}  // namespace grainreel
