// Tests of the times that `check` estimates: what they consist of, and what is kept about the machine's
// speed.
#include "render/app/estimate/cost_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "engine/measure/columns.hpp"
#include "render/app/estimate/engine_cost.hpp"
#include "render/app/estimate/speed_cache.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;

FilmedScene scene_with(const std::vector<std::string>& sets) {
    return read_filmed_scene_text(small_scene_text, "fifty.toml", sets, measurable_in);
}

CostEstimate cost_of(const FilmedScene& scene, const ThreadPlan& threads, const MachineFigures& machine) {
    const Plan plan = make_plan(scene);
    return estimate_cost(scene, plan, count_film(scene, plan.clock, plan.steps), threads, machine);
}

const ThreadPlan in_turn{1, 1, 1, true}, beside{1, 1, 1, false};
const MachineFigures machine{1e7, 1e7, 0.02, 0.4, 2};

TEST(CostEstimate, IsInverseToTheMachinesSpeed) {
    MachineFigures faster = machine;
    faster.lattice_one = 4 * machine.lattice_one;
    const CostEstimate slow = cost_of(scene_with({}), in_turn, machine);
    const CostEstimate fast = cost_of(scene_with({}), in_turn, faster);
    EXPECT_GT(slow.engine_seconds, 0);
    EXPECT_NEAR(slow.engine_seconds, 4 * fast.engine_seconds, 1e-9 * slow.engine_seconds);
    EXPECT_NEAR(slow.packing_seconds, 4 * fast.packing_seconds, 1e-9 * slow.packing_seconds);
    EXPECT_EQ(slow.film_seconds, fast.film_seconds);
}

// The scene has 12 frames and one more: 0.2 s at half speed and 30 frames a second.
TEST(CostEstimate, EngineAndFilmTakeTurnsOrDoNot) {
    const CostEstimate turns = cost_of(scene_with({}), in_turn, machine);
    const CostEstimate together = cost_of(scene_with({}), beside, machine);
    EXPECT_EQ(turns.frames, 13);
    EXPECT_DOUBLE_EQ(turns.frame_seconds, machine.frame_seconds);
    const double rest = turns.total_seconds - turns.engine_seconds - turns.film_seconds;
    EXPECT_NEAR(together.total_seconds, rest + std::max(turns.engine_seconds, turns.film_seconds), 1e-12);
}

// A grain has 4.5 contacts, few of which are left while the bed is thrown up. Stages count by their time.
TEST(CostEstimate, ABedAtRestHasItsContactsAllTheTime) {
    const auto contacts = [](std::vector<std::string> sets) {
        sets.emplace_back("drive.ramp=0");
        const FilmedScene scene = scene_with(sets);
        return mean_contacts(scene, make_plan(scene));
    };
    EXPECT_DOUBLE_EQ(contacts({"drive.g_level=0.9"}), 4.5);
    EXPECT_DOUBLE_EQ(contacts({"drive.g_level=3", "drive.direction=[0, 1, 0]"}), 4.5);  // along the floor
    EXPECT_EQ(contacts({"gravity=0", "drive.amplitude=1 mm"}), 0);
    const double two = contacts({"drive.g_level=2"}), three = contacts({"drive.g_level=3"});
    EXPECT_LT(two, 0.2 * 4.5);
    EXPECT_LT(three, two);
    const std::vector<std::string> rests = {"drive.g_level=2",
                                            "drive.stage=[{from = \"0.05 s\", kind = \"rest\"}]"};
    EXPECT_NEAR(contacts(rests), 0.25 * two + 0.75 * 4.5, 1e-12);
    const double thrown =
        cost_of(scene_with({"drive.g_level=3", "drive.ramp=0"}), in_turn, machine).engine_one;
    const double lies = cost_of(scene_with({"drive.g_level=0.9"}), in_turn, machine).engine_one;
    EXPECT_GT(thrown / lies, 2);
}

// The amplitude grows over 0.15 s of the 0.2 s, by a smooth step that is a half at half its time.
TEST(CostEstimate, TheBedLiesUntilTheDriveHasGrown) {
    const auto contacts = [](const std::string& level, const std::string& ramp) {
        const FilmedScene scene = scene_with({"drive.g_level=" + level, "drive.ramp=" + ramp});
        return mean_contacts(scene, make_plan(scene));
    };
    EXPECT_DOUBLE_EQ(contacts("0.9", "3"), 4.5);
    const double sudden = contacts("2", "0"), grown = contacts("2", "3");
    const double lies = 0.5 * 0.15 / 0.2;
    EXPECT_GT(grown, lies * 4.5 + (1 - lies) * sudden);
    EXPECT_LT(grown, 0.75 * 4.5 + 0.25 * sudden);
    EXPECT_LT(contacts("4", "3"), grown);
}

TEST(CostEstimate, WhatIsMeasuredCosts) {
    const auto seconds = [](const std::vector<std::string>& sets) {
        return cost_of(scene_with(sets), in_turn, machine).engine_seconds;
    };
    const double none = seconds({});
    const double walls = seconds({"output.instruments=[\"walls\"]"});
    const double balance = seconds({"output.instruments=[\"energy_balance\"]"});
    const double fields = seconds({"output.fields.grid=yz", "output.fields.periods=1"});
    EXPECT_GT(walls, none);
    EXPECT_LT(walls, 1.1 * none);
    EXPECT_GT(balance, 1.5 * none);
    EXPECT_GT(fields, none);
    // Twice as many moments cost twice as much.
    const double often =
        seconds({"output.fields.grid=yz", "output.fields.periods=1", "output.fields.samples=32"});
    EXPECT_NEAR((often - none) / (fields - none), 2, 0.05);
}

// Two threads that share a core do not halve the time of a film.
TEST(CostEstimate, AFilmGainsWhatTwoThreadsGain) {
    MachineFigures shared = machine;
    shared.gain_of_two = 1.25;
    const CostEstimate two = cost_of(scene_with({}), in_turn, machine);
    const CostEstimate one_core = cost_of(scene_with({}), in_turn, shared);
    const double used = 13 * machine.frame_seconds;
    EXPECT_NEAR(two.film_seconds, used * (1 - machine.frame_drawing) + film_setup_seconds, 1e-12);
    EXPECT_NEAR(one_core.film_seconds, used / 1.25 + film_setup_seconds, 1e-12);
    const CostEstimate one_thread = cost_of(scene_with({"run.threads=1"}), in_turn, machine);
    EXPECT_NEAR(one_thread.film_seconds, used + film_setup_seconds, 1e-12);
}

TEST(CostEstimate, ABoxThatIsOnlyFedIsNotPacked) {
    EXPECT_GT(cost_of(scene_with({}), in_turn, machine).packing_seconds, 0);
    const CostEstimate fed =
        cost_of(read_filmed_scene_text(fed_scene_text, "fed.toml", {}), in_turn, machine);
    EXPECT_EQ(fed.packing_seconds, 0);
    EXPECT_EQ(fed.packing_share, 0);
    EXPECT_GT(fed.engine_seconds, 0);
}

// A picture of eight moments is drawn eight times and encoded once.
TEST(CostEstimate, CountsWhatAnExposureDraws) {
    const CostEstimate open = cost_of(
        scene_with({"film.segment[0].exposure=5 ms", "film.segment[0].exposures=8"}), in_turn, machine);
    const double moments = 8, d = machine.frame_drawing;
    EXPECT_NEAR(open.frame_seconds, machine.frame_seconds * (1 - d + moments * d), 1e-12);
}

TEST(CostEstimate, OneProcessorDrawsAndEncodesInTurn) {
    MachineFigures one = machine;
    one.processors = 1;
    const CostEstimate alone = cost_of(scene_with({}), in_turn, one);
    EXPECT_NEAR(alone.film_seconds, 13 * one.frame_seconds + film_setup_seconds, 1e-12);
    EXPECT_LT(cost_of(scene_with({}), in_turn, machine).film_seconds, alone.film_seconds);
}

// Threads gain what was measured for the team, and never more than their number; with 1000 grains they gain
// half of it.
TEST(CostEstimate, ThreadsGainWhatTheTeamGains) {
    MachineFigures team = machine;
    team.lattice_team = 1.6 * team.lattice_one;
    const FilmedScene scene = scene_with({});
    const auto grains = static_cast<double>(scene.grains());
    const double share = grains / (grains + 1000);
    const double one = cost_of(scene, {1, 1, 1, true}, team).packing_seconds;
    EXPECT_NEAR(cost_of(scene, {2, 1, 1, true}, team).packing_seconds, one / (1 + 0.6 * share), 1e-9 * one);
    team.lattice_team = 50 * team.lattice_one;
    EXPECT_NEAR(cost_of(scene, {2, 1, 1, true}, team).packing_seconds, one / (1 + share), 1e-9 * one);
    team.lattice_team = 0.1 * team.lattice_one;  // as if measured while the machine was busy
    EXPECT_NEAR(cost_of(scene, {2, 1, 1, true}, team).packing_seconds, one, 1e-9 * one);
}

TEST(StackedBed, HoldsAllGrainsInsideTheContainer) {
    for (const char* shape : {"box", "cylinder"}) {
        const FilmedScene scene =
            std::string(shape) == "box"
                ? scene_with({})
                : read_filmed_scene_text(
                      std::string(small_scene_text)
                          .replace(
                              std::string(small_scene_text)
                                  .find("shape = \"box\"\nwidth = \"30 mm\"\n"
                                        "depth = \"20 mm\""),
                              std::string("shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"").size(),
                              "shape = \"cylinder\"\ndiameter = \"30 mm\""),
                      "fifty.toml");
        const State bed = stacked_bed(scene);
        ASSERT_EQ(bed.size(), 50u);
        EXPECT_EQ(std::count(bed.species.begin(), bed.species.end(), 1), 10);
        for (const Vec3& at : bed.position) {
            EXPECT_LE(std::abs(at.y()), scene.container.half_width);
            EXPECT_GT(at.z(), 0);
            EXPECT_LT(at.z(), scene.container.height);
        }
    }
}

class SpeedCacheIn : public testing::Test {
  protected:
    void SetUp() override {
        if (const char* value = std::getenv("XDG_CACHE_HOME")) before = value;
        ::setenv("XDG_CACHE_HOME", here.path().c_str(), 1);
    }
    void TearDown() override {
        before ? ::setenv("XDG_CACHE_HOME", before->c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
    }
    static void keep_some() {
        SpeedCache cache;
        cache.keep_engine(2, 3e7);
        cache.keep_film("look", {0.03, 0.6});
        cache.save();
    }

    TemporaryFolder here;
    std::optional<std::string> before;
};

TEST_F(SpeedCacheIn, AFolderIsReadAgain) {
    keep_some();
    const SpeedCache cache;
    EXPECT_EQ(cache.engine(2), 3e7);
    EXPECT_FALSE(cache.engine(1));
    ASSERT_TRUE(cache.film("look"));
    EXPECT_EQ(cache.film("look")->seconds, 0.03);
    EXPECT_EQ(cache.film("look")->drawing, 0.6);
    EXPECT_FALSE(cache.film("another"));
}

TEST_F(SpeedCacheIn, DamageCountsAsNothingAndIsReplaced) {
    keep_some();
    const fs::path file = SpeedCache().path();
    const std::string whole = text_of(file);
    std::string other = whole, negative = whole;
    other.replace(other.find("grainreel"), 9, "grainmill");
    negative.replace(negative.find("30000000.0"), 10, "-1.0");
    for (const std::string& text : {std::string(), std::string("{"), std::string("[]"),
                                    std::string("\x00\xff", 2), std::string("{\"machine\": 3}"), other,
                                    negative, whole.substr(0, whole.size() / 2), std::string(2 << 20, ' ')}) {
        write_text(file, text);
        EXPECT_FALSE(SpeedCache().engine(2)) << text.substr(0, 80);
        keep_some();
        EXPECT_EQ(SpeedCache().engine(2), 3e7);
    }
}

TEST_F(SpeedCacheIn, AFolderThatCannotBeMadeKeepsNothing) {
    write_text(here / "file", "");
    ::setenv("XDG_CACHE_HOME", (here / "file").c_str(), 1);
    keep_some();
    EXPECT_FALSE(SpeedCache().engine(2));
    ::setenv("XDG_CACHE_HOME", "relative", 1);  // the standard says that a relative path has no meaning
    EXPECT_TRUE(SpeedCache().path().empty() || SpeedCache().path().is_absolute());
}

}  // namespace
}  // namespace grainreel
