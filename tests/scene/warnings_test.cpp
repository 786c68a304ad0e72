// Tests of each warning of the plan, in a scene in which it must appear and in a similar one in which it must
// not.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/plan/contact_kinds.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/plan_parts.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::HasSubstr;
using testing::Not;

std::string warnings(const std::string& text, Assignments sets = {}) {
    std::string all;
    for (const std::string& line : plan_with_film(read_text(text, sets)).warnings) all += line + "\n";
    return all;
}

// A bed of 1,500 beads that are shaken, and one intruder of three diameters.
const std::string nut_text = test::SmallScene()
                                 .beads(1500, "bead", "3 mm")
                                 .beads(1, "nut", "9 mm")
                                 .contacts("0.8", "0.3")
                                 .cylinder("45 mm", "100 mm")
                                 .shaken("20 Hz", "3")
                                 .lasts("2 s")
                                 .text();

TEST(Warnings, OfASoftBedIsNotSetOffByOneIntruder) {
    const auto soft = HasSubstr("behaves like a soft body");
    EXPECT_EQ(warnings(nut_text), "");
    // With one stiffness for all, the slowest contacts are those of the intruder, which has one at a time.
    const Plan plan = make_plan(read_text(nut_text));
    const double chosen = plan.between(0, 0).loading_stiffness;
    EXPECT_THAT(warnings(nut_text, {fmt::format("contact.stiffness={}", chosen)}), Not(soft));
    EXPECT_THAT(warnings(nut_text, {fmt::format("contact.stiffness={}", 5 * chosen)}), Not(soft));
    // t ~ K^(-1/2): in contacts as soft as this, waves take twenty times as long.
    EXPECT_THAT(warnings(nut_text, {fmt::format("contact.stiffness={}", chosen / 400)}),
                testing::AllOf(soft, HasSubstr("between \"bead\" and \"nut\"")));
}

TEST(Warnings, OfContactsThatLastLongGoByMostOfThem) {
    const Plan plan = make_plan(read_text(nut_text));
    const auto turned = HasSubstr("so that rebounds are off");
    // For a single grain without others the wall is too soft.
    const std::string nut_at_wall =
        "[[contact.pair]]\nbetween = [\"nut\", \"wall\"]\nstiffness = 30\n[container]";
    EXPECT_THAT(warnings(with(nut_text, "[container]", nut_at_wall)), Not(turned));
    EXPECT_THAT(warnings(nut_text, {"contact.wall.stiffness=30"}), turned);
}

TEST(Warnings, OfOverlapsNameThePairThatHasThem) {
    const std::string soft_nut =
        "[[contact.pair]]\nbetween = [\"nut\", \"bead\"]\nstiffness = 100\n[container]";
    EXPECT_THAT(warnings(with(nut_text, "[container]", soft_nut)),
                testing::AllOf(tells({"\"bead\" and \"nut\"", "0.05", "most contacts"}),
                               tells({"raise the stiffness", "pair"})));
    EXPECT_THAT(warnings(nut_text, {"contact.stiffness=50"}), HasSubstr("are expected in most contacts"));
    const Plan plan = make_plan(read_text(nut_text));
    EXPECT_LT(plan.usual_overlap, 0.012) << "as wanted, for most";
    EXPECT_GT(plan.expected_overlap, 2 * plan.usual_overlap);
    EXPECT_EQ(plan.deepest, "\"bead\" and \"bead\" under \"nut\"");
}

// A lone grain never meets another of its species, and without walls no grain meets a wall.
TEST(Warnings, LeaveOutPairsThatCannotMeet) {
    const FilmedScene nut = read_text(nut_text);
    const Plan plan = make_plan(nut);
    std::vector<std::string> names;
    double shares = 0;
    for (const ContactKind& kind : contact_kinds(nut, plan)) {
        names.push_back(kind.name);
        if (!kind.at_wall) shares += kind.share;
    }
    EXPECT_THAT(names, testing::ElementsAre("\"bead\" and \"bead\"", "\"bead\" and \"nut\"",
                                            "\"bead\" and a wall", "\"nut\" and a wall"));
    EXPECT_NEAR(shares, 1, 1e-12);
    const auto tunnels = HasSubstr("may pass through");
    const std::string nut_nut =
        "[[contact.pair]]\nbetween = [\"nut\", \"nut\"]\nstiffness = 0.01\n[container]";
    EXPECT_THAT(warnings(with(nut_text, "[container]", nut_nut)), Not(tunnels));
    EXPECT_THAT(warnings(with(nut_text, "[container]", nut_nut), {"species.nut.count=2"}), tunnels);
    const std::string no_walls = with(exact_text,
                                      "[[wall]]\npoint = [0, 0, \"-3 mm\"]\nnormal = [0, 0, 2]\n"
                                      "velocity = [0, 0, \"10 cm/s\"]\n",
                                      "");
    const FilmedScene scene = read_text(no_walls);
    for (const ContactKind& kind : contact_kinds(scene, make_plan(scene))) EXPECT_FALSE(kind.at_wall);
}

TEST(Warnings, OfAWeakDriveOnlyWhereNothingElseMoves) {
    const auto still = HasSubstr("stays on the floor");
    EXPECT_THAT(warnings(nut_text, {"drive.g_level=0.99"}), still);
    EXPECT_THAT(warnings(nut_text, {"drive.g_level=1"}), Not(still));
    EXPECT_THAT(warnings(nut_text, {"drive.g_level=0.5", "container.outlet.diameter=20 mm"}), Not(still));
    EXPECT_THAT(warnings(nut_text, {"drive.g_level=0.5", "drive.direction=[1, 0, 0]"}), Not(still));
}

// A stage that begins at 0 replaces the drive, so what the drive would do does not matter.
TEST(Warnings, OfADriveThatIsReplacedAtOnceAreNotGiven) {
    const std::string stage = nut_text + "[[drive.stage]]\nfrom = 0\nfrequency = \"20 Hz\"\ng_level = 3\n";
    for (const char* set : {"drive.ramp=0", "drive.ramp=100"}) {
        EXPECT_THAT(warnings(nut_text, {set}), HasSubstr("drive.ramp"));
        EXPECT_EQ(warnings(stage, {set}), "");
    }
    const Assignments slow{"drive.frequency=0.4 Hz", "drive.amplitude=1 mm"};
    EXPECT_THAT(warnings(nut_text, slow), HasSubstr("one period of"));
    EXPECT_THAT(warnings(stage, slow), Not(HasSubstr("one period of")));
}

TEST(Warnings, OfHeatWithoutLimitOnlyWhereNothingIsLost) {
    const auto hot = HasSubstr("heats the grains without limit");
    EXPECT_THAT(warnings(nut_text, {"contact.restitution=1", "contact.friction=0"}), hot);
    EXPECT_THAT(warnings(nut_text, {"contact.restitution=1"}), Not(hot)) << "they rub";
    const std::string nut_nut =
        "[[contact.pair]]\nbetween = [\"nut\", \"nut\"]\nrestitution = 1\n[container]";
    EXPECT_THAT(warnings(with(nut_text, "[container]", nut_nut), {"contact.friction=0"}), Not(hot));
    const Assignments dashpot{"contact.law=spring-dashpot", "contact.friction=0"};
    Assignments none = dashpot;
    none.push_back("contact.normal_damping=0");
    EXPECT_THAT(warnings(nut_text, none), hot);
    EXPECT_THAT(warnings(nut_text, dashpot), Not(hot));
}

TEST(Warnings, OfAnOutletAndAPeriodNameTheFewThatAreTooLarge) {
    const Assignments slot{"container.outlet.diameter=15 mm"};  // exactly five beads
    EXPECT_THAT(warnings(nut_text, slot),
                testing::AllOf(Not(HasSubstr("grains wide")), HasSubstr("1.7 grains of \"nut\" wide")));
    EXPECT_THAT(warnings(nut_text, {"container.outlet.diameter=14.9 mm"}), HasSubstr("grains wide"));
    EXPECT_THAT(warnings(nut_text, {"container.outlet.diameter=45 mm"}), Not(HasSubstr("outlet")));
    const std::string box =
        with(nut_text, "shape = \"cylinder\"\ndiameter = \"45 mm\"",
             "shape = \"box\"\nwidth = \"60 mm\"\ndepth = \"24 mm\"\nperiodic_depth = true");
    EXPECT_THAT(warnings(box), tells({"period", "2.67 diameters", "\"nut\""}));
    EXPECT_THAT(warnings(box, {"species.nut.diameter=4 mm"}), Not(HasSubstr("the period is"))) << "six";
    EXPECT_THAT(warnings(box, {"container.depth=17 mm", "species.nut.diameter=4 mm"}),
                tells({"period", "5.67 diameters", "grains"}));
}

TEST(Warnings, OfFewStepsNameTheContact) {
    EXPECT_THAT(warnings(nut_text, {"run.step=1e-4"}), tells({"\"bead\" and \"bead\"", "lasts"}));
    EXPECT_THAT(warnings(nut_text, {"run.step=1e-6"}), Not(HasSubstr("steps where")));
}

TEST(Warnings, OfGrainsThatCrossMuchInAStepGoByThoseThatMove) {
    // A species that only occurs glued to the floor is never that fast.
    const std::string glued = with(nut_text, "[contact]",
                                   "[[species]]\nname = \"dust\"\ndiameter = \"0.05 mm\"\ndensity = 2500\n"
                                   "[contact]");
    const Assignments rough{
        "container.wall_grains={ species = \"dust\", faces = [\"floor\"], spacing = \"0.5 mm\" }",
        "run.step=1e-5"};
    EXPECT_THAT(warnings(glued, rough), Not(tells({"smallest radius", "in one step"})));
    EXPECT_THAT(warnings(nut_text, {"run.step=3e-4"}), tells({"smallest radius", "in one step"}));
}

// ---- restitution ----

double restitution_of(const PairPlan& pair, double mass) {
    const double beta = pair.damping_rate(mass) / (2 * std::sqrt(pair.loading_stiffness / mass));
    return std::exp(-std::numbers::pi * beta / std::sqrt(1 - beta * beta));
}

const Assignments spread{"species.bead.diameter={ min = \"1 mm\", max = \"4 mm\" }",
                         "contact.law=spring-dashpot", "contact.attraction=true"};

TEST(PlanDamping, KeepsTheRestitutionThatIsAskedForAtEverySize) {
    Assignments asked = spread;
    asked.push_back("contact.restitution=0.5");
    const FilmedScene scene = read_text(nut_text, asked);
    const Plan plan = make_plan(scene);
    for (const PairSizes& t : extremes(scene.species[0], &scene.species[0]))
        EXPECT_NEAR(restitution_of(plan.between(0, 0), t.effective_mass), 0.5, 1e-12);
    for (const PairSizes& t : extremes(scene.species[0], nullptr))
        EXPECT_NEAR(restitution_of(plan.wall[0], t.effective_mass), 0.5, 1e-12);
    const RestitutionRange range =
        restitution_range(plan, plan.between(0, 0), scene.species[0], &scene.species[0]);
    EXPECT_NEAR(range.low, 0.5, 1e-12);
    EXPECT_NEAR(range.high, 0.5, 1e-12);
    const PairPlan& pair = plan.between(0, 0);
    EXPECT_DOUBLE_EQ(pair.tangential_damping_rate(1e-5), pair.damping_rate(1e-5) / 2);
    // If all grains have one size, there is one restitution, as before.
    EXPECT_EQ(plan.between(1, 1).damping_by_root, 0);
    EXPECT_GT(plan.between(1, 1).normal_damping, 0);
}

TEST(PlanDamping, ThatIsGivenStaysAndTheRangeIsTold) {
    Assignments given = spread;
    for (const char* more : {"contact.normal_damping=500", "contact.stiffness=1e4"}) given.push_back(more);
    const FilmedScene scene = read_text(nut_text, given);
    const Plan plan = make_plan(scene);
    const PairPlan& pair = plan.between(0, 0);
    EXPECT_EQ(pair.normal_damping, 500);
    EXPECT_EQ(pair.damping_by_root, 0);
    const RestitutionRange range = restitution_range(plan, pair, scene.species[0], &scene.species[0]);
    const std::vector<PairSizes> sizes = extremes(scene.species[0], &scene.species[0]);
    EXPECT_NEAR(range.high, restitution_of(pair, sizes.front().effective_mass), 1e-12);
    EXPECT_NEAR(range.low, restitution_of(pair, sizes.back().effective_mass), 1e-12);
    EXPECT_LT(range.low, range.high - 0.02);
}

TEST(PlanDamping, ARestitutionThatFallsWithSpeedHasARangeToo) {
    const Assignments sets{"species.bead.diameter={ min = \"1 mm\", max = \"4 mm\" }",
                           "contact.restitution=0.7", "contact.restitution_speed=0.3 m/s"};
    const FilmedScene scene = read_text(nut_text, sets);
    const Plan plan = make_plan(scene);
    const PairPlan& pair = plan.between(0, 0);
    const auto e = [&](double mass) {
        const double natural = std::sqrt(pair.loading_stiffness / mass);
        return std::sqrt(natural / (natural + pair.hardening * plan.impact_speed));
    };
    const std::vector<PairSizes> sizes = extremes(scene.species[0], &scene.species[0]);
    const RestitutionRange range = restitution_range(plan, pair, scene.species[0], &scene.species[0]);
    EXPECT_NEAR(range.high, e(sizes.front().effective_mass), 1e-12);
    EXPECT_NEAR(range.low, e(sizes.back().effective_mass), 1e-12);
    const Plan hertz = make_plan(read_text(nut_text, {spread[0], "contact.law=hertz"}));
    EXPECT_EQ(restitution_range(hertz, hertz.between(0, 0), scene.species[0], &scene.species[0]).low, 0.8);
}

// Strong dashpots act on a grain from all sides. They limit the step where springs alone would allow more.
TEST(PlanStep, FollowsStrongDashpots) {
    const Assignments strong{"contact.law=spring-dashpot", "contact.friction=0", "contact.restitution=0.05"};
    const Plan plan = make_plan(read_text(nut_text, strong));
    EXPECT_THAT(plan.step_reason, tells({"dashpots", "\"bead\"", "twelve neighbours"}));
    const double mass = 2500 * std::numbers::pi / 6 * std::pow(0.003, 3);
    EXPECT_LT(plan.clock.step * 8 * plan.between(0, 0).damping_rate(mass / 2) / 2, 1);
    EXPECT_THAT(make_plan(read_text(nut_text, {strong[0], strong[1]})).step_reason,
                HasSubstr("steps in a contact"));
}

}  // namespace
}  // namespace grainreel
