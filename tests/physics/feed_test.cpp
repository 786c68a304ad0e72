// Tests of grains that come during the run: how many there are at a time, where they may appear, their energy
// and momentum, and the same bits on any number of threads and through a checkpoint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "engine/base/error.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::HasSubstr;

const std::string kBox = test::SmallScene()
                             .beads(0, "small", "2 mm")
                             .beads(4, "big", "3 mm to 4 mm")
                             .more("[contact]\nstiffness = 700\n")
                             .box("20 mm", "20 mm", "60 mm")
                             .more("top = \"open\"\n[start]\nsettle_limit = \"0.05 s\"\n")
                             .lasts("0.4 s")
                             .more("threads = 1\n")
                             .text();
constexpr const char* kTwoFeeds = R"(
[[feed]]
species = "small"
rate = 400
from = "0.05 s"
[[feed]]
species = "big"
count = 12
until = "0.2 s"
velocity = ["0.1 m/s", 0, "-0.3 m/s"]
)";
constexpr const char* kShaken = R"(
[drive]
frequency = 40
g_level = 2
)";

Scene scene_of(const std::string& more, const std::vector<std::string>& sets = {}) {
    return read_scene_text(fmt::format("{}{}", kBox, more), "box.toml", with_tested_precision(sets));
}

constexpr std::int64_t kLook = 200;  // steps

// After t seconds a feed has given rate x (t - from) grains at the last multiple of 200 steps, and no more
// than its count. No grain waits here, because the box is wide.
TEST(Feed, GivesRateTimesTime) {
    const Scene scene = scene_of(kTwoFeeds);
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    EXPECT_EQ(run.grains(), 4u);
    for (const double share : {0.1, 0.2, 0.4, 0.7, 1.0}) {
        const auto step = static_cast<std::int64_t>(share * static_cast<double>(plan.steps));
        run.advance(step);
        const double looked = plan.clock.time(step / kLook * kLook);
        const double small = std::floor(400 * std::max(0.0, looked - 0.05) + 1e-9);
        const double big = std::min(12.0, std::floor(12 / 0.2 * looked + 1e-9));
        EXPECT_EQ(static_cast<double>(run.grains()), 4 + small + big) << looked;
    }
    EXPECT_EQ(scene.species[0].all(), 140);
    EXPECT_EQ(scene.species[1].all(), 16);
    EXPECT_EQ(scene.grains(), 156);
}

double gap(const State& f, std::size_t a, std::size_t b) {
    return (f.position[a] - f.position[b]).norm() - f.radius[a] - f.radius[b];
}

// When a grain appears it is a thousandth of its radius away from every other grain and from the walls. It
// has a size of its species, lies in its box and has its velocity; and ids rise.
TEST(Feed, AppearsWhereNothingIs) {
    const std::string low =
        "[[feed]]\nspecies = \"big\"\nrate = 3000\ncount = 60\n"
        "low = [-0.008, -0.008, 0.02]\nhigh = [0.01, 0.01, 0.04]\nvelocity = [0, 0, -1]\n";
    const Scene scene = scene_of(low, {"species[0].count=1"});
    SimulatedBed run(scene, make_plan(scene), 1);
    run.pack();
    std::size_t there = run.grains();
    for (std::int64_t step = kLook; run.grains() < 65; step += kLook) {
        run.advance(step);
        const State f = run.frame();
        for (std::size_t i = there; i < f.size(); ++i) {
            EXPECT_EQ(f.id[i], static_cast<std::int32_t>(i));
            EXPECT_EQ(f.velocity[i], Vec3(0, 0, -1));
            EXPECT_GE(f.radius[i], 1.5e-3);
            EXPECT_LE(f.radius[i], 2e-3);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(f.position[i][axis], scene.feeds[0].low[axis]);
                EXPECT_LE(f.position[i][axis], scene.feeds[0].high[axis]);
            }
            EXPECT_GE(0.01 - f.position[i].cwiseAbs().head(2).maxCoeff(), 1.001 * f.radius[i]);
            for (std::size_t k = 0; k < i; ++k)
                EXPECT_GE(gap(f, i, k), 0.999e-3 * f.radius[i]) << i << " " << k;
        }
        there = f.size();
    }
    EXPECT_EQ(there, 65u);
}

// If nothing touches, a grain that came with v0 at t0 has the momentum m (v0 + g (t - t0)). The energies are
// those at the start plus what came in, because velocity Verlet follows a parabola exactly.
TEST(Feed, KeepsTheAccountOfMomentumAndEnergy) {
    const Scene scene = scene_of(
        "[[feed]]\nrate = 2000\ncount = 20\nvelocity = [0, 0, \"2 m/s\"]\n"
        "low = [-0.009, -0.009, 0.02]\nhigh = [0.009, 0.009, 0.05]\n",
        {"species[1].count=1"});
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    const Measures start = run.measures();
    const auto energy = [](const Measures& m) {
        return m.at("kinetic_J") + m.at("rotational_J") + m.at("gravitational_J") + m.at("elastic_J");
    };
    double expected = 0, mass = 0;
    std::size_t there = run.grains();
    std::int64_t step = 0;
    while (run.grains() < 21) {
        run.advance(step += kLook);
        const State f = run.frame();
        for (; there < f.size(); ++there) {
            const double m = 2500 * 4.0 / 3 * std::numbers::pi * std::pow(f.radius[there], 3);
            expected += m * (2 + 9.81 * plan.clock.time(step)), mass += m;
        }
    }
    const State f = run.frame();
    double momentum = 0;
    for (std::size_t i = 1; i < f.size(); ++i)
        momentum += 2500 * 4.0 / 3 * std::numbers::pi * std::pow(f.radius[i], 3) * f.velocity[i].z();
    EXPECT_NEAR(momentum, expected - mass * 9.81 * plan.clock.time(step), 1e-9 * std::abs(expected));
    EXPECT_EQ(run.traffic().came, 20);
    EXPECT_NEAR(energy(run.measures()), energy(start) + run.traffic().energy_in,
                1e-4 * run.traffic().energy_in);
}

std::uint64_t end_of(const Scene& scene, int threads) {
    SimulatedBed run(scene, make_plan(scene), threads);
    run.pack();
    run.advance(make_plan(scene).steps);
    return run.state_hash();
}

TEST(Feed, HasTheSameBitsOnAnyNumberOfThreads) {
    const Scene scene = scene_of(fmt::format("{}{}", kTwoFeeds, kShaken), {"run.duration=0.1 s"});
    const std::uint64_t one = end_of(scene, 1);
    EXPECT_EQ(end_of(scene, 2), one);
    EXPECT_EQ(end_of(scene, 3), one);
}

TEST(Feed, GoesOnFromACheckpoint) {
    const test::TemporaryFolder folder;
    const std::string file = (folder / "half.grs").string();
    const Scene scene = scene_of(fmt::format("{}{}", kTwoFeeds, kShaken));
    const Plan plan = make_plan(scene);
    SimulatedBed straight(scene, plan, 1);
    straight.pack();
    straight.advance(plan.steps / 3);
    straight.save_checkpoint(file);
    straight.advance(plan.steps);
    std::string text = fmt::format("{}{}{}", kBox, kTwoFeeds, kShaken);
    const std::string start = "[start]\nsettle_limit = \"0.05 s\"\n";
    text.replace(text.find(start), start.size(),
                 fmt::format("[start]\nmethod = \"file\"\nkeep_clock = true\nfile = \"{}\"\n", file));
    const Scene next = read_scene_text(text, "box.toml", with_tested_precision({}));
    SimulatedBed again(next, make_plan(next), 2);
    EXPECT_EQ(again.step(), plan.steps / 3);
    again.pack();
    again.advance(plan.steps);
    EXPECT_EQ(again.state_hash(), straight.state_hash());
    EXPECT_EQ(again.grains(), straight.grains());
}

TEST(Feed, IntoAFullContainerStops) {
    const Scene scene = scene_of(
        "[[feed]]\nrate = 20000\ncount = 600\nlow = [-0.01, -0.01, 0]\n"
        "high = [0.01, 0.01, 0.006]\n",
        {"run.duration=2 s"});
    SimulatedBed run(scene, make_plan(scene), 1);
    run.pack();
    try {
        run.advance(make_plan(scene).steps);
        FAIL() << run.grains();
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), HasSubstr("box.toml:23:1: at "));
        EXPECT_THAT(error.what(), HasSubstr("lower the 'rate'"));
    }
}

// The container is empty at first.
TEST(Feed, FillsAnEmptyContainer) {
    const Scene scene = scene_of(kTwoFeeds, {"species[1].count=1"});
    Scene empty = scene;
    empty.species[1].count = 0;
    SimulatedBed run(empty, make_plan(empty), 1);
    run.pack();
    EXPECT_EQ(run.grains(), 0u);
    EXPECT_TRUE(std::isnan(run.measures().at("centre_z_m")));
    const Plan plan = make_plan(empty);
    run.advance(plan.steps);
    const double looked = plan.clock.time(plan.steps / kLook * kLook);
    EXPECT_EQ(static_cast<double>(run.grains()), 12 + std::floor(400 * (looked - 0.05)));
}

}  // namespace
}  // namespace grainreel
