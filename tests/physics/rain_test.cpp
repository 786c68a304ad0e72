// Tests of a start by rain: all grains come, with the species mixed, and the bed is whole and at rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {
namespace {

const std::string kText = test::SmallScene()
                              .beads(160, "small", "1.8 mm to 2 mm")
                              .beads(80, "big", "3 mm")
                              .more("[contact]\nstiffness = 700\n")
                              .wedge("20 deg", "15 mm", "12 mm", "18 mm", "40 mm")
                              .more("[start]\nmethod = \"rain\"\nsettle_limit = \"1 s\"\n")
                              .lasts("0.1 s")
                              .text();

Scene scene_of(const std::vector<std::string>& sets = {}) {
    return read_scene_text(kText, "rain.toml", with_tested_precision(sets));
}

TEST(Rain, FillsTheContainerAndComesToRest) {
    const Scene scene = scene_of();
    SimulatedBed run(scene, make_plan(scene), 1);
    const PackingResult packed = run.pack();
    EXPECT_TRUE(packed.finished);
    EXPECT_TRUE(packed.settled);
    EXPECT_EQ(run.step(), 0);
    EXPECT_EQ(run.traffic().came, 0) << "the account begins with the drive";
    const State f = run.frame();
    ASSERT_EQ(f.size(), 240u);
    std::int64_t big = 0, early = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        EXPECT_EQ(f.id[i], static_cast<std::int32_t>(i));
        big += f.species[i] == 1;
        early += f.species[i] == 1 && i < 120;
        EXPECT_LT(f.velocity[i].norm(), 0.05);
    }
    EXPECT_EQ(big, 80);
    // Half of the big grains are among the first half, within four deviations of drawing without replacement:
    // n K (N - K) (N - n) / (N^2 (N - 1)).
    const double N = 240, n = 120, K = 80;
    const double deviation = std::sqrt(n * K * (N - K) * (N - n) / (N * N * (N - 1)));
    EXPECT_NEAR(static_cast<double>(early), n * K / N, 4 * deviation);
    for (std::size_t a = 0; a < f.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const double overlap = f.radius[a] + f.radius[b] - (f.position[a] - f.position[b]).norm();
            EXPECT_LT(overlap, 0.02 * f.radius[a]);
        }
}

TEST(Rain, HasTheSameBitsOnAnyNumberOfThreads) {
    const Scene scene = scene_of({"start.rain_rate=4000", "start.settle_limit=0.05 s"});
    std::uint64_t one = 0;
    for (const int threads : {1, 2, 3}) {
        SimulatedBed run(scene, make_plan(scene), threads);
        run.pack();
        run.advance(200);
        if (threads == 1) one = run.state_hash();
        EXPECT_EQ(run.state_hash(), one) << threads;
    }
}

TEST(Rain, EndsWithWhatToDoWhereThereIsNoRoom) {
    const Scene scene =
        scene_of({"container.height=15.1 mm", "species.small.count=410", "start.rain_rate=20000"});
    SimulatedBed run(scene, make_plan(scene), 1);
    try {
        run.pack();
        FAIL();
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("finds no room"));
        EXPECT_THAT(error.what(), testing::HasSubstr("a higher container"));
    }
}

}  // namespace
}  // namespace grainreel
