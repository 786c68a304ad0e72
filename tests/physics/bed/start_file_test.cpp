// Runs that start anew from a file: a bed at rest stays at rest, whatever the law, and one that moves is
// never damped.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/run/simulation.hpp"
#include "engine/scene/text/reader.hpp"
#include "engine/scene/text/writer.hpp"
#include "engine/start/grain_table.hpp"
#include "engine/start/restart.hpp"
#include "tests/cli/temporary_folder.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kDiameter = 0.004;

const char* const kSpecies = R"([[species]]
name = "beads"
count = 60
diameter = { min = "3.5 mm", max = "4.5 mm" }
density = "2.5 g/cm3"
[contact]
restitution = 0.5
friction = 0.5
)";
const char* const kBox = R"([container]
shape = "box"
width = "18 mm"
depth = "16 mm"
height = "50 mm"
)";

class StartFile : public testing::Test {
  protected:
    static Scene scene_of(const std::string& more, std::vector<std::string> sets) {
        sets.insert(sets.begin(), {"run.duration=0.05", "run.threads=1"});
        return read_scene_text(kSpecies + more, "bed.toml", with_tested_precision(sets));
    }
    Scene next_of(const std::string& more, const char* file, std::vector<std::string> sets) const {
        sets.insert(sets.end(), {"start.method=file", "start.file=" + (here / file).string()});
        return scene_of(more, sets);
    }

    struct Rest {
        double contacts = 0, height = 0, energy = 0;  // a grain; m; over m g d
    };
    static Rest rest_of(const Simulation& run, const Scene& scene) {
        const double mass = scene.species[0].density * std::numbers::pi / 6 * std::pow(kDiameter, 3);
        const double unit = static_cast<double>(run.grains()) * mass * scene.gravity.norm() * kDiameter;
        return {run.measure("contact_number"), run.measure("centre_z_m"),
                (run.measure("kinetic_J") + run.measure("rotational_J")) / unit};
    }
    // A bed that has settled and then lain still, in both files.
    Rest settle(const Scene& scene, double still = 0.02) const {
        const Plan plan = make_plan(scene);
        Simulation run(scene, plan, 1);
        run.pack();
        run.advance(std::llround(still / plan.clock.step));
        write_grain_table(here / "final.csv", run.frame());
        run.save_checkpoint(here / "checkpoint.grs");
        return rest_of(run, scene);
    }
    // Runs on for `seconds`; contacts within `share` of before at every look, and nothing moves.
    static void expect_rest(const Scene& scene, const Rest& before, double share, const std::string& what,
                            double seconds = 0.02) {
        const Plan plan = make_plan(scene);
        Simulation run(scene, plan, 1);
        const PackingResult packed = run.pack();
        EXPECT_TRUE(packed.settled) << what;
        constexpr int looks = 20;
        Rest worst{before.contacts, before.height, 0};
        for (int look = 0; look <= looks; ++look) {
            run.advance(std::llround(look * seconds / looks / plan.clock.step));
            const Rest now = rest_of(run, scene);
            if (std::abs(now.contacts - before.contacts) > std::abs(worst.contacts - before.contacts))
                worst.contacts = now.contacts;
            worst.height = std::max(worst.height, now.height);
            worst.energy = std::max(worst.energy, now.energy);
        }
        EXPECT_LT(worst.energy, 1e-3) << what;
        EXPECT_NEAR(worst.contacts, before.contacts, share * before.contacts) << what;
        EXPECT_LT(worst.height, before.height + 1e-3 * kDiameter) << what;
        if (std::getenv("SHOW"))
            fmt::print("{}: energy {:.2g}, contacts {:.3f} -> {:.3f}, rise {:.2g} d, packed {:.3f} s\n", what,
                       worst.energy, before.contacts, worst.contacts,
                       (worst.height - before.height) / kDiameter, packed.settle_time);
    }
    test::TemporaryFolder here;
};

const std::vector<std::string> kLaws = {"walton-braun", "spring-dashpot", "hertz"};

std::string law(const std::string& name) {
    return "contact.law=" + name;
}

TEST_F(StartFile, ABedAtRestStaysAtRestUnderTheSameLaw) {
    for (const std::string& name : kLaws) {
        const Scene scene = scene_of(kBox, {law(name)});
        const Rest before = settle(scene);
        for (const char* file : {"final.csv", "checkpoint.grs"}) {
            const Scene next = next_of(kBox, file, {law(name)});
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
    Simulation run(stiff, plan, 1);
    run.pack();
    EXPECT_LT(rest_of(run, stiff).energy, 1e-4);
    EXPECT_NEAR(run.measure("centre_z_m"), before.height, 0.02 * kDiameter);
}

// Of a table alone only the overlaps are known. Those of springs carry the weight at the stiffness that made
// them; latched ones are larger than their forces, and the plan's own conditions give more.
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

// In free fall: the velocities of the file are those of the run, in both files and whatever the law.
TEST_F(StartFile, ABedThatMovesKeepsItsMomentum) {
    const std::string drive = "[drive]\nfrequency = \"20 Hz\"\ng_level = 3\n[film]\nsegment = [{}]\n";
    const Scene scene = scene_of(kBox + drive, {"run.duration=0.3"});
    const Plan plan = make_plan(scene);
    Simulation run(scene, plan, 1);
    run.pack();
    run.advance(plan.clock.steps_per_period * 35 / 8);
    run.save_checkpoint(here / "checkpoint.grs");
    for (const std::string& other : kLaws) {
        const Scene next = next_of(kBox, "checkpoint.grs", {law(other)});
        const Plan anew = make_plan(next);
        EXPECT_FALSE(anew.start.relaxes) << other;
        EXPECT_THAT(anew.start.text, HasSubstr("it is not damped"));
        EXPECT_EQ(anew.start.keeps_histories, other == "walton-braun");
        Simulation begun(next, anew, 1);
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
    EXPECT_THAT(text_of(kBox, {"gravity=[1, 0, -9.7]"}), HasSubstr("gravity is not that of the file's run"));
    EXPECT_THAT(text_of(kBox, {"gravity=0", "contact.stiffness=1000"}), HasSubstr("without gravity"));
    EXPECT_THAT(text_of(kBox, {"container.width=30 mm"}), HasSubstr("the walls are not those"));
    // Nothing touches the lid.
    EXPECT_TRUE(make_plan(next_of(kBox, "final.csv", {"container.height=60 mm"})).start.relaxes);
    EXPECT_TRUE(make_plan(next_of(kBox, "final.csv", {"container.top=open"})).start.relaxes);
}

// Alone, a table does not say where the walls were. A bed that has lost one flows, and starts as it is.
TEST_F(StartFile, ABedWithoutItsWallsIsTakenBack) {
    settle(scene_of(kBox, {}));
    fs::remove(here / "checkpoint.grs");
    const Scene wide = next_of(kBox, "final.csv", {"container.width=40 mm", "contact.friction=0.1"});
    const Plan plan = make_plan(wide);
    ASSERT_TRUE(plan.start.relaxes);
    Simulation run(wide, plan, 1);
    const Frame before = run.frame();
    const PackingResult packed = run.pack();
    EXPECT_FALSE(packed.settled);
    const Frame after = run.frame();
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(after.position[i], before.position[i]) << i;
        EXPECT_EQ(after.velocity[i], before.velocity[i]) << i;
    }
}

struct Around {
    const char *name, *container;
    std::vector<std::string> before, sets, laws;
};

const char* const kWedge = R"([container]
shape = "wedge"
half_width = "12 mm"
half_angle = "20 deg"
slant_height = "15 mm"
height = "50 mm"
depth = "16 mm"
)";
const char* const kCylinder = R"([container]
shape = "cylinder"
diameter = "18 mm"
height = "50 mm"
)";

// With what else a scene may have; the same bits on any number of threads, and from a checkpoint on the way.
TEST_F(StartFile, IsAlikeInEveryContainer) {
    const std::string rolls = "contact.rolling_friction=0.1", round = "container.periodic_depth=true";
    const std::string glued = "container.wall_grains={species=\"beads\", faces=[\"floor\"]}";
    const std::string outlet = "container.outlet={ width = \"9 mm\", opens = 0.02 }";
    const std::string feed = "feed=[{rate = 500, count = 5, until = 0.04}]";
    const std::vector<Around> all = {
        {"cylinder", kCylinder, {}, {}, {kLaws[0]}},
        {"wedge", kWedge, {rolls}, {rolls}, {kLaws[0], kLaws[1]}},
        {"periodic", kBox, {round}, {round}, {kLaws[0]}},
        {"glued", kBox, {glued}, {glued}, {kLaws[0], kLaws[1]}},
        {"fed", kBox, {}, {outlet, feed}, {kLaws[0]}},
    };
    for (const Around& one : all) {
        const Rest before = settle(scene_of(one.container, one.before), 0.005);
        for (const std::string& other : one.laws) {
            std::vector<std::string> sets = one.sets;
            sets.push_back(law(other));
            const Scene next = next_of(one.container, "checkpoint.grs", sets);
            const Plan plan = make_plan(next);
            EXPECT_EQ(plan.start.relaxes, other != kLaws[0]) << one.name;
            std::uint64_t hash = 0;
            for (const int threads : {1, 2, 3}) {
                Simulation run(next, plan, threads);
                EXPECT_TRUE(run.pack().settled) << one.name;
                const double share = plan.start.relaxes ? 0.2 : 0.05;
                EXPECT_NEAR(run.measure("contact_number"), before.contacts, share * before.contacts)
                    << one.name << ", " << other;
                if (threads == 1) run.save_checkpoint(here / "begun.grs");
                run.advance(300);
                if (threads == 1) hash = run.state_hash();
                EXPECT_EQ(run.state_hash(), hash) << one.name << ", " << threads << " threads";
            }
            Simulation on = Simulation::at_checkpoint(next, plan, here / "begun.grs", 2);
            on.advance(300);
            EXPECT_EQ(on.state_hash(), hash) << one.name;
        }
    }
}

// Only the walls have another law: contacts between grains go on, those at walls begin anew.
TEST_F(StartFile, HistoriesAreKeptKindByKind) {
    const std::string big = "[[species]]\nname = \"big\"\ncount = 5\ndiameter = \"7 mm\"\ndensity = 2500\n";
    const Rest before = settle(scene_of(big + kBox, {}));
    const Scene next = next_of(big + kBox, "checkpoint.grs", {"contact.wall.law=spring-dashpot"});
    const Plan plan = make_plan(next);
    EXPECT_TRUE(plan.start.keeps_histories && plan.start.relaxes);
    EXPECT_EQ(plan.between(0, 1).stiffness_reason, "the start file");
    EXPECT_EQ(plan.wall[1].stiffness_reason, "overlaps in the start file");
    EXPECT_THAT(plan.start.text, HasSubstr("contacts whose law is the file's keep their histories"));
    expect_rest(next, before, 0.2, "walls of another law");
}

TEST_F(StartFile, ADriveThatWantsMoreIsSaid) {
    settle(scene_of(kBox, {}));
    const std::string drive = "[drive]\nfrequency = \"10 Hz\"\ng_level = 5\n";
    const auto warnings = [&](const std::string& more) {
        const Plan plan = make_plan(next_of(more, "checkpoint.grs", {}));
        EXPECT_EQ(plan.between(0, 0).stiffness_reason, "the start file");
        return plan.warnings;
    };
    EXPECT_THAT(warnings(kBox + drive),
                testing::Contains(HasSubstr("start.file: the stiffness follows from")));
    EXPECT_THAT(warnings(kBox), testing::Not(testing::Contains(HasSubstr("start.file"))));
}

// A bed whose histories are kept goes on as one that never stopped, up to rounding.
TEST_F(StartFile, KeptHistoriesGoOnAsBefore) {
    for (const std::string& name : kLaws) {
        const Scene scene = scene_of(kBox, {law(name), "contact.rolling_friction=0.1"});
        const Plan plan = make_plan(scene);
        Simulation whole(scene, plan, 1);
        whole.pack();
        whole.save_checkpoint(here / "checkpoint.grs");
        const Scene next = next_of(kBox, "checkpoint.grs", {law(name), "contact.rolling_friction=0.1"});
        Simulation anew(next, make_plan(next), 1);
        anew.pack();
        whole.advance(100), anew.advance(100);
        const Frame one = whole.frame(), other = anew.frame();
        for (std::size_t i = 0; i < one.size(); ++i)
            EXPECT_LT((one.position[i] - other.position[i]).norm(), of_rounding(1e-12, 1e-7) * kDiameter)
                << name << ", grain " << i;
        EXPECT_NEAR(anew.measure("elastic_J"), whole.measure("elastic_J"),
                    of_rounding(1e-6, 1e-3) * whole.measure("elastic_J"));
    }
}

}  // namespace
}  // namespace grainreel
