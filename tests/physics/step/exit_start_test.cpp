// Tests of grains that lie in an exit when the bed is packed: exits act from the start of the drive on, and
// who lies in one then leaves at step 0.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/grain_table.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/mesh/mesh_files.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using test::tells;
using test::TemporaryFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double kExitFrom = 0.010;  // m, y beyond which the exit lies

const std::string kBed = test::SmallScene()
                             .beads(60, "small", "3.6 mm to 4.4 mm", "1100")
                             .beads(5, "large", "6 mm")
                             .contacts("0.5", "0.3")
                             .box("40 mm", "20 mm", "60 mm")
                             .more("[start]\nsettle_limit = \"0.2 s\"\n")
                             .lasts("0.05 s")
                             .more("accuracy = \"draft\"\n")
                             .more("[output]\ninstruments = [\"outflow\", \"energy_balance\", \"walls\"]\n")
                             .text();
constexpr const char* kExit = "[[exit]]\nlow = [-1, 0.010, -1]\nhigh = [1, 1, 1]\n";

Scene scene_of(const std::string& text, std::vector<std::string> sets = {}) {
    return read_scene_text(text, "bed.toml", with_tested_precision(std::move(sets)), measurable_in);
}

double mass_of(const Departure& one, const Scene& scene) {
    return scene.species[static_cast<std::size_t>(one.species)].density * 4.0 / 3 * std::numbers::pi *
           std::pow(one.radius, 3);
}

TEST(Exits, AreToldWhereGrainsComeInThem) {
    const auto warnings = [](const std::string& feed) {
        const Scene scene = scene_of(kBed + kExit + "[[feed]]\nspecies = \"large\"\nrate = 50\n" + feed);
        return make_plan(scene).warnings;
    };
    EXPECT_THAT(warnings("low = [0, 0.012, 0.04]\nhigh = [0.001, 0.015, 0.05]\n"),
                Contains(tells({"bed.toml:", "100 %", "feed's box", "leave at once"})));
    EXPECT_THAT(warnings("low = [0, 0.001, 0.04]\nhigh = [0.001, 0.009, 0.05]\n"),
                Not(Contains(HasSubstr("leave at once"))));
}

struct Start {
    State packed;  // before anybody leaves
    PackingResult result;
    std::vector<Departure> left;  // until a step
    std::uint64_t hash = 0;       // at that step
};

Start start_of(const Scene& scene, int threads, std::int64_t until = 0) {
    Start start;
    SimulatedBed run(scene, make_plan(scene), threads);
    start.result = run.pack([](const PackingProgress&) { return true; },
                            [&](const PackingResult&) { start.packed = run.frame(); });
    run.advance(until);
    start.left = run.take_departures();
    start.hash = run.state_hash();
    return start;
}

void expect_same(const Start& one, const Start& other, const std::string& what) {
    EXPECT_EQ(one.hash, other.hash) << what;
    ASSERT_EQ(one.left.size(), other.left.size()) << what;
    for (std::size_t i = 0; i < one.left.size(); ++i) {
        EXPECT_EQ(one.left[i].id, other.left[i].id) << what;
        EXPECT_EQ(one.left[i].step, other.left[i].step) << what;
        EXPECT_EQ(one.left[i].position, other.left[i].position) << what;
    }
}

TEST(ExitAtStart, ThePackingIsThatWithoutAnExitAndWhoLiesInItLeavesAtOnce) {
    for (const char* method : {"layers", "rain"}) {
        const std::vector<std::string> sets{fmt::format("start.method={}", method)};
        const Scene scene = scene_of(std::string(kBed) + kExit, sets), without = scene_of(kBed, sets);
        const Start start = start_of(scene, 1), plain = start_of(without, 1);
        ASSERT_EQ(start.packed.id, plain.packed.id) << method;
        std::vector<std::int32_t> in_exit;
        double all = 0, leaves = 0;
        for (std::size_t i = 0; i < start.packed.size(); ++i) {
            EXPECT_EQ(start.packed.position[i], plain.packed.position[i]) << method;
            const double cube = std::pow(start.packed.radius[i], 3);
            all += cube;
            if (start.packed.position[i].y() < kExitFrom) continue;
            in_exit.push_back(start.packed.id[i]);
            leaves += cube;
        }
        ASSERT_GT(in_exit.size(), 5u) << method;
        std::vector<std::int32_t> gone;
        for (const Departure& one : start.left) {
            EXPECT_EQ(one.step, 0) << method;
            gone.push_back(one.id);
        }
        EXPECT_EQ(gone, in_exit) << method;
        EXPECT_EQ(start.result.left, in_exit.size()) << method;
        EXPECT_NEAR(start.result.left_share, leaves / all, 1e-12) << method;
        EXPECT_EQ(plain.result.left, 0u) << method;
    }
}

TEST(ExitAtStart, IsTheSameOnAnyNumberOfThreads) {
    for (const char* method : {"layers", "rain"}) {
        const Scene scene = scene_of(
            std::string(kBed) + kExit,
            {fmt::format("start.method={}", method), "gravity=[0, 3, -9]", "start.settle_limit=0.05 s"});
        const Start one = start_of(scene, 1, 400);
        EXPECT_GT(one.left.size(), one.result.left) << "more roll into the exit";
        for (const int threads : {2, 3}) expect_same(start_of(scene, threads, 400), one, method);
    }
}

// The mass that has left is the mass of the departures, at step 0 and later; and the rate does not count
// those of step 0.
TEST(ExitAtStart, OutflowCountsThem) {
    const Scene scene = scene_of(std::string(kBed) + kExit);
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    double mass = 0, at_start = 0;
    const auto take = [&] {
        for (const Departure& one : run.take_departures()) mass += mass_of(one, scene);
    };
    take();
    at_start = mass;
    ASSERT_GT(mass, 0);
    EXPECT_NEAR(run.measure("outflow_kg"), mass, 1e-12 * mass);
    EXPECT_TRUE(std::isnan(run.measure("outflow_rate")));
    const auto row = static_cast<std::int64_t>(std::llround(plan.measures_every));
    run.advance(row);
    take();
    EXPECT_NEAR(run.measure("outflow_kg"), mass, 1e-12 * mass);
    EXPECT_NEAR(run.measure("outflow_rate"), (mass - at_start) / plan.clock.time(row), 1e-9);
}

// The run has at its start what it has now, what has left, and what was lost.
TEST(ExitAtStart, TheEnergyBalanceIsThatOfTheGrainsThatStay) {
    const Scene scene = scene_of(std::string(kBed) + kExit);
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    const double held = run.measure("gravitational_J");
    EXPECT_NEAR(run.measure("lost_J"), 0, 1e-12 * held) << "nothing is lost when grains leave at step 0";
    EXPECT_NO_THROW(run.advance(plan.steps));
    EXPECT_GT(run.measure("lost_J"), 0);
}

TEST(ExitAtStart, ACheckpointOfAnyStepGoesOnBitByBit) {
    const TemporaryFolder here;
    for (const char* feed : {"",
                             "[[feed]]\nspecies = \"small\"\nrate = 2000\nlow = [-0.005, -0.015, 0.05]\n"
                             "high = [0.005, 0.015, 0.056]\n"}) {
        const Scene scene = scene_of(std::string(kBed) + kExit + feed);
        const Plan plan = make_plan(scene);
        for (const std::int64_t step : {0, 150}) {
            SimulatedBed whole(scene, plan, 1);
            whole.pack();
            ASSERT_GT(whole.traffic().left, 0);
            whole.advance(step);
            whole.save_checkpoint(here / "half.grs");
            whole.take_departures();
            for (const int threads : {1, 2, 3}) {
                SimulatedBed rest = SimulatedBed::at_checkpoint(scene, plan, here / "half.grs", threads);
                EXPECT_EQ(rest.state_hash(), whole.state_hash()) << step;
                EXPECT_EQ(rest.traffic().left, whole.traffic().left);
                EXPECT_TRUE(rest.take_departures().empty()) << "they have left before";
                rest.advance(step + 300);
                SimulatedBed other = SimulatedBed::at_checkpoint(scene, plan, here / "half.grs", 1);
                other.advance(step + 300);
                EXPECT_EQ(rest.state_hash(), other.state_hash()) << step << ", " << threads << " threads";
                EXPECT_EQ(rest.measure("outflow_kg"), other.measure("outflow_kg"));
            }
            whole.advance(step + 300);
            SimulatedBed rest = SimulatedBed::at_checkpoint(scene, plan, here / "half.grs", 1);
            rest.advance(step + 300);
            EXPECT_EQ(rest.state_hash(), whole.state_hash()) << step;
            EXPECT_EQ(rest.measure("outflow_kg"), whole.measure("outflow_kg")) << step;
        }
    }
}

// A kept packing holds all grains; those in an exit leave when a run begins with it.
TEST(ExitAtStart, AKeptPackingBeginsTheSameRun) {
    const TemporaryFolder here;
    const Scene scene = scene_of(std::string(kBed) + kExit);
    const Plan plan = make_plan(scene);
    SimulatedBed packs(scene, plan, 1);
    const std::string key = packs.packing_key();
    const PackingResult result =
        packs.pack([](const PackingProgress&) { return true; },
                   [&](const PackingResult& packed) { packs.save_packing(here / "kept.grs", key, packed); });
    ASSERT_GT(result.left, 0u);
    for (const int threads : {1, 2, 3}) {
        PackingResult found;
        auto takes = SimulatedBed::with_packing(scene, plan, here / "kept.grs", key, threads, found);
        ASSERT_TRUE(takes);
        EXPECT_EQ(found.left, result.left);
        EXPECT_EQ(found.left_share, result.left_share);
        EXPECT_EQ(takes->state_hash(), packs.state_hash());
        EXPECT_EQ(takes->take_departures().size(), result.left);
        EXPECT_EQ(takes->measure("outflow_kg"), packs.measure("outflow_kg"));
        EXPECT_EQ(takes->measure("lost_J"), packs.measure("lost_J"));
    }
}

// Without a container to hold them, some grains fall beside a plate, into an exit far below and through it,
// if nothing stopped them there.
class ExitBelowAPlate : public MeshFiles {};

TEST_F(ExitBelowAPlate, GrainsThatFallIntoAnExitWhileTheBedIsPackedWaitThere) {
    write("plate.stl", box_of_triangles(Vec3(-0.02, -0.02, -0.004), Vec3(0.02, 0.02, 0)));
    constexpr double kLow = -0.10, kHigh = -0.02;  // m, of the exit
    for (const char* method : {"layers", "rain"}) {
        const Scene scene =
            read(test::SmallScene()
                     .beads(150)
                     .more("[contact]\nfriction = 0.5\n")
                     .empty_space()
                     .more("[[mesh]]\nname = \"plate\"\nfile = \"plate.stl\"\n")
                     .more("[[exit]]\nlow = [-1, -1, -0.10]\nhigh = [1, 1, -0.02]\n")
                     .more("[start]\nregion = { low = [-0.03, -0.03, 0.002], high = [0.03, 0.03, 0.06] }\n")
                     .more("settle_limit = \"1 s\"\n")
                     .lasts("0.05 s")
                     .more("accuracy = \"draft\"\n")
                     .text(),
                 {fmt::format("start.method={}", method)});
        const Start start = start_of(scene, 1);
        EXPECT_EQ(start.packed.size(), 150u) << method;
        ASSERT_GT(start.left.size(), 10u) << method;
        EXPECT_LT(start.left.size(), 140u) << method;
        for (const Departure& one : start.left) {
            EXPECT_EQ(one.step, 0);
            EXPECT_GT(one.position.z(), kLow) << method;
            EXPECT_LT(one.position.z(), kHigh) << method;
            EXPECT_LT(one.velocity.norm(), 0.1) << method << ": it waits";
        }
        std::size_t below = 0;
        for (const Vec3& place : start.packed.position) below += place.z() < kHigh;
        EXPECT_EQ(below, start.left.size()) << method << ": nobody fell through";
        for (const int threads : {2, 3}) expect_same(start_of(scene, threads), start, method);
    }
}

// ---- from files, and warnings

std::string warning_of(const Scene& scene) {
    for (const std::string& one : make_plan(scene).warnings)
        if (one.find("in an exit") != one.npos) return one;
    return "";
}

// The table is that of a bed without an exit, so it rests and is relaxed before the drive starts.
TEST(ExitAtStart, GrainsOfAFileLeaveToo) {
    const TemporaryFolder here;
    const Scene bed = scene_of(kBed);
    SimulatedBed first(bed, make_plan(bed), 1);
    first.pack();
    write_grain_table(here / "final.csv", first.frame());
    first.save_checkpoint(here / "checkpoint.grs");
    std::int64_t inside = 0;
    for (const Vec3& place : first.frame().position) inside += place.y() >= kExitFrom;
    for (const char* file : {"final.csv", "checkpoint.grs"}) {
        std::string text = std::string(kBed) + kExit;
        const std::string settles = "settle_limit = \"0.2 s\"";
        text.replace(text.find(settles), settles.size(), "method = \"file\"");
        const Scene scene = scene_of(text, {"start.file=" + (here / file).string()});
        EXPECT_THAT(warning_of(scene), HasSubstr(fmt::format(": {} of 65 grains", inside))) << file;
        const Start start = start_of(scene, 1);
        EXPECT_EQ(start.packed.size(), 65u) << file;
        EXPECT_NEAR(static_cast<double>(start.left.size()), static_cast<double>(inside), 2) << file;
        for (const Departure& one : start.left) EXPECT_EQ(one.step, 0) << file;
    }
}

// The bed lies between y = -20 mm and 20 mm, and centres half a diameter inside of that. The exit takes what
// lies beyond 10 mm.
TEST(ExitAtStart, ThePlanWarnsOfABedInAnExit) {
    const std::string warning = warning_of(scene_of(std::string(kBed) + kExit));
    const double radius = 0.0018, share = (0.020 - radius - kExitFrom) / (0.040 - 2 * radius);
    EXPECT_THAT(warning, HasSubstr(fmt::format("about {:.0f} of 65 grains", std::round(65 * share))));
    EXPECT_THAT(warning, HasSubstr("move the exit away"));
    EXPECT_EQ(warning_of(scene_of(kBed)), "");
    const std::string below = "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, 0.0017]\n",
                      around = "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, 1]\noutside = true\n",
                      none = "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 0, 1]\noutside = true\n";
    EXPECT_EQ(warning_of(scene_of(kBed + below)), "") << "no centre comes so near the floor";
    EXPECT_EQ(warning_of(scene_of(kBed + around)), "");
    EXPECT_THAT(warning_of(scene_of(kBed + none)), HasSubstr("of 65 grains (5"));
}

TEST(ExitAtStart, ListedGrainsLeaveAtOnce) {
    const Scene scene =
        scene_of(test::SmallScene("gravity = 10\n")
                     .beads(0, "ball")
                     .more("[contact]\nstiffness = \"1000 N/m\"\n")
                     .empty_space()
                     .more("[[grain]]\nposition = [0, 0, 0.05]\n[[grain]]\nposition = [0, 0.02, -0.05]\n")
                     .more("[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, 0]\n")
                     .lasts("0.12 s")
                     .more("step = 1e-5\n")
                     .text());
    EXPECT_THAT(warning_of(scene), tells({": 1 of 2 grains", "50 %", "in an exit"}));
    const Start start = start_of(scene, 1);
    ASSERT_EQ(start.left.size(), 1u);
    EXPECT_EQ(start.left[0].id, 1);
    EXPECT_EQ(start.left[0].step, 0);
    EXPECT_EQ(start.left[0].position, Vec3(0, 0.02, -0.05));
}

}  // namespace
}  // namespace grainreel
