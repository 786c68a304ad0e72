// Tests of runs that start anew from a file: a bed at rest stays at rest whatever the law, and a bed that
// moves is never damped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/plan/resolved_scene.hpp"
#include "tests/physics/bed/start_file.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::tells;
using testing::HasSubstr;

TEST_F(StartFile, ABedAtRestStaysAtRestUnderTheSameLaw) {
    for (const std::string& name :
         {law(kLaws[0]), law(kLaws[1]), law(kLaws[2]), std::string("contact.restitution_speed=1")}) {
        const Scene scene = scene_of(kBox, {name});
        const Rest before = settle(scene);
        for (const char* file : {"final.csv", "checkpoint.grs"}) {
            const Scene next = next_of(kBox, file, {name});
            const Plan plan = make_plan(next), first = make_plan(scene);
            EXPECT_EQ(plan.between(0, 0).loading_stiffness, first.between(0, 0).loading_stiffness);
            EXPECT_EQ(plan.clock.step, first.clock.step);
            EXPECT_EQ(plan.between(0, 0).stiffness_reason, "the start file");
            EXPECT_EQ(plan.start.relaxes, file == std::string("final.csv"));
            EXPECT_EQ(plan.start.keeps_histories, !plan.start.relaxes);
            expect_rest(next, before, 0.05, name + ", " + file);
        }
        // The scene that the run wrote has its stiffness in it.
        const Scene own =
            read_scene_text(resolved_scene(scene, make_plan(scene)), "scene.toml",
                            {"start.method=file", "start.file=" + (here / "checkpoint.grs").string()});
        EXPECT_TRUE(make_plan(own).start.keeps_histories);
        EXPECT_FALSE(make_plan(own).start.relaxes);
        expect_rest(own, before, 0.05, name + ", its own scene");
    }
}

TEST_F(StartFile, ABedAtRestComesToRestUnderAnotherLaw) {
    for (const std::string& name : kLaws) {
        const Rest before = settle(scene_of(kBox, {law(name)}));
        for (const std::string& other : kLaws) {
            if (other == name) continue;
            const Scene next = next_of(kBox, "checkpoint.grs", {law(other)});
            const Plan plan = make_plan(next);
            EXPECT_TRUE(plan.start.relaxes && !plan.start.keeps_histories);
            if (other != "walton-braun") {
                EXPECT_EQ(plan.wall[0].stiffness_reason, "overlaps in the start file");
            }
            expect_rest(next, before, 0.2, name + " to " + other);
        }
    }
}

TEST_F(StartFile, TheStiffnessOfTheSceneWins) {
    const Scene scene = scene_of(kBox, {});
    const Rest before = settle(scene);
    const double there = make_plan(scene).between(0, 0).loading_stiffness;
    const Scene stiff = next_of(kBox, "checkpoint.grs", {fmt::format("contact.stiffness={}", 10 * there)});
    const Plan plan = make_plan(stiff);
    EXPECT_EQ(plan.between(0, 0).loading_stiffness, 10 * there);
    EXPECT_TRUE(plan.start.relaxes);
    SimulatedBed run(stiff, plan, 1);
    run.pack();
    EXPECT_LT(rest_of(run, stiff).energy, 1e-4);
    EXPECT_NEAR(run.measure("centre_z_m"), before.height, 0.02 * kBedDiameter);
}

// A table alone has only the overlaps. Overlaps of springs carry the weight at the stiffness that made them.
// Overlaps of latched contacts are larger than their forces need, so the plan's own conditions give a higher
// stiffness.
TEST_F(StartFile, OverlapsTellTheStiffness) {
    for (const std::string& name : kLaws) {
        const std::vector<std::string> sets = {law(name), "contact.friction=0"};
        std::vector<std::string> first = sets;
        first.push_back(name == "hertz" ? "contact.modulus=5e6" : "contact.stiffness=1000");
        settle(scene_of(kBox, first));
        fs::remove(here / "checkpoint.grs");
        const Plan plan = make_plan(next_of(kBox, "final.csv", sets));
        const PairPlan& pair = plan.between(0, 0);
        EXPECT_TRUE(plan.start.relaxes);
        if (name == "walton-braun") {
            EXPECT_GT(pair.loading_stiffness, 500);
            continue;
        }
        EXPECT_EQ(pair.stiffness_reason, "overlaps in the start file");
        const double found = name == "hertz" ? pair.modulus : pair.loading_stiffness;
        const double there = name == "hertz" ? 5e6 : 1000;
        EXPECT_NEAR(found, there, 0.02 * there) << name;
    }
}

// The bed falls freely. The velocities of the file are those of the run, in both files and whatever the law.
TEST_F(StartFile, ABedThatMovesKeepsItsMomentum) {
    const std::string drive = "[drive]\nfrequency = \"20 Hz\"\ng_level = 3\n[film]\nsegment = [{}]\n";
    const Scene scene = scene_of(kBox + drive, {"run.duration=0.3"});
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    run.advance(plan.clock.steps_per_period * 35 / 8);
    run.save_checkpoint(here / "checkpoint.grs");
    for (const std::string& other : kLaws) {
        const Scene next = next_of(kBox, "checkpoint.grs", {law(other)});
        const Plan anew = make_plan(next);
        EXPECT_FALSE(anew.start.relaxes) << other;
        EXPECT_THAT(anew.start.text, tells({"nothing is damped", "bed in the file moves"}));
        EXPECT_EQ(anew.start.keeps_histories, other == "walton-braun");
        SimulatedBed begun(next, anew, 1);
        const double before = begun.measure("kinetic_J");
        EXPECT_GT(before, 0);
        begun.pack();
        EXPECT_EQ(begun.measure("kinetic_J"), before) << other;
    }
}

TEST_F(StartFile, OtherSurroundingsAreSaid) {
    settle(scene_of(kBox, {}));
    const auto text_of = [&](const std::string& box, const std::vector<std::string>& sets) {
        const Plan plan = make_plan(next_of(box, "final.csv", sets));
        EXPECT_FALSE(plan.start.relaxes);
        return plan.start.text;
    };
    EXPECT_THAT(text_of(kBox, {"gravity=[1, 0, -9.7]"}), tells({"gravity", "not that", "file's run"}));
    EXPECT_THAT(text_of(kBox, {"gravity=0", "contact.stiffness=1000"}), HasSubstr("without gravity"));
    EXPECT_THAT(text_of(kBox, {"container.width=30 mm"}), HasSubstr("the walls are not those"));
    // Nothing touches the lid.
    EXPECT_TRUE(make_plan(next_of(kBox, "final.csv", {"container.height=60 mm"})).start.relaxes);
    EXPECT_TRUE(make_plan(next_of(kBox, "final.csv", {"container.top=open"})).start.relaxes);
}

// A table alone does not say where the walls were. A bed that has lost a wall flows, and starts as it is.
TEST_F(StartFile, ABedWithoutItsWallsIsTakenBack) {
    settle(scene_of(kBox, {}));
    fs::remove(here / "checkpoint.grs");
    const Scene wide = next_of(kBox, "final.csv", {"container.width=40 mm", "contact.friction=0.1"});
    const Plan plan = make_plan(wide);
    ASSERT_TRUE(plan.start.relaxes);
    SimulatedBed run(wide, plan, 1);
    const State before = run.frame();
    const PackingResult packed = run.pack();
    EXPECT_FALSE(packed.settled);
    const State after = run.frame();
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(after.position[i], before.position[i]) << i;
        EXPECT_EQ(after.velocity[i], before.velocity[i]) << i;
    }
}

// A bed whose histories are kept continues as one that never stopped, up to rounding.
TEST_F(StartFile, KeptHistoriesGoOnAsBefore) {
    for (const std::string& name : kLaws) {
        const Scene scene = scene_of(kBox, {law(name), "contact.rolling_friction=0.1"});
        const Plan plan = make_plan(scene);
        SimulatedBed whole(scene, plan, 1);
        whole.pack();
        whole.save_checkpoint(here / "checkpoint.grs");
        const Scene next = next_of(kBox, "checkpoint.grs", {law(name), "contact.rolling_friction=0.1"});
        SimulatedBed anew(next, make_plan(next), 1);
        anew.pack();
        whole.advance(100), anew.advance(100);
        const State one = whole.frame(), other = anew.frame();
        for (std::size_t i = 0; i < one.size(); ++i)
            EXPECT_LT((one.position[i] - other.position[i]).norm(), of_rounding(1e-12, 1e-7) * kBedDiameter)
                << name << ", grain " << i;
        EXPECT_NEAR(anew.measure("elastic_J"), whole.measure("elastic_J"),
                    of_rounding(1e-6, 1e-3) * whole.measure("elastic_J"));
    }
}

}  // namespace
}  // namespace grainreel
