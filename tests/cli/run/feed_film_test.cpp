// Tests of a scene with a feed, run by the program: its files have room for all grains, and it is drawn
// again.
#include <gtest/gtest.h>

#include <fstream>

#include "engine/files/trajectory/trajectory.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

TEST(FeedFilm, HasRoomForAllAndIsDrawnAgain) {
    const test::TemporaryFolder here;
    std::ofstream(here / "fed.toml") << test::small_scene_text
                                     << "[[feed]]\nrate = 100\nspecies = \"small\"\n";
    const auto program = [&](const std::vector<std::string>& words) {
        return test::run_program(words, {.folder = here.path()});
    };
    const test::Ended movie = program({"movie", "fed.toml", "--out", "run", "--set", "run.threads=1"});
    ASSERT_EQ(movie.status, 0) << movie.err;
    const TrajectoryReader reader(here / "run/trajectory.nc");
    EXPECT_EQ(reader.info().capacity, 70u) << "50 at the start, and 100 a second for 0.2 s";
    EXPECT_EQ(reader.read(0).size(), 50u);
    // The last frame of the trajectory is the run's end; the last look at the feed was up to 200 steps
    // before.
    const State last = reader.read(reader.frames() - 1);
    EXPECT_GE(last.size(), 69u);
    EXPECT_EQ(last.id.back(), static_cast<std::int32_t>(last.size()) - 1);
    const test::Ended again = program({"render", "run", "--out", "again"});
    EXPECT_EQ(again.status, 0) << again.err;
}

}  // namespace
}  // namespace grainreel
