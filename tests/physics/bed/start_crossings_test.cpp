// Tests of starts from a file in scenes with other features.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/physics/bed/start_file.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::HasSubstr;

class StartCrossings : public StartFile {};

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

// Whatever else the scene has, the bits are the same on any number of threads and from a checkpoint on the
// way.
TEST_F(StartCrossings, IsAlikeInEveryContainer) {
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
                SimulatedBed run(next, plan, threads);
                EXPECT_TRUE(run.pack().settled) << one.name;
                const double share = plan.start.relaxes ? 0.2 : 0.05;
                EXPECT_NEAR(run.measure("contact_number"), before.contacts, share * before.contacts)
                    << one.name << ", " << other;
                if (threads == 1) run.save_checkpoint(here / "begun.grs");
                run.advance(300);
                if (threads == 1) hash = run.state_hash();
                EXPECT_EQ(run.state_hash(), hash) << one.name << ", " << threads << " threads";
            }
            SimulatedBed on = SimulatedBed::at_checkpoint(next, plan, here / "begun.grs", 2);
            on.advance(300);
            EXPECT_EQ(on.state_hash(), hash) << one.name;
        }
    }
}

// Only the walls get another law: contacts between grains go on, and contacts with walls begin anew.
TEST_F(StartCrossings, HistoriesAreKeptKindByKind) {
    const std::string big = "[[species]]\nname = \"big\"\ncount = 5\ndiameter = \"7 mm\"\ndensity = 2500\n";
    const Rest before = settle(scene_of(big + kBox, {}));
    const Scene next = next_of(big + kBox, "checkpoint.grs", {"contact.wall.law=spring-dashpot"});
    const Plan plan = make_plan(next);
    EXPECT_TRUE(plan.start.keeps_histories && plan.start.relaxes);
    EXPECT_EQ(plan.between(0, 1).stiffness_reason, "the start file");
    EXPECT_EQ(plan.wall[1].stiffness_reason, "overlaps in the start file");
    EXPECT_THAT(plan.start.text, tells({"law", "the file's", "keep their histories"}));
    expect_rest(next, before, 0.2, "walls of another law");
}

TEST_F(StartCrossings, ADriveThatWantsMoreIsSaid) {
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

}  // namespace
}  // namespace grainreel
