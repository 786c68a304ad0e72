// Tests of an orbit in a film: it lasts as long as the film, unless the scene gives its length.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;

class OrbitFilm : public testing::Test {
  protected:
    // The bytes of every frame of the film.
    std::vector<std::string> frames(const std::string& run, std::vector<std::string> words) {
        words.insert(words.begin(), {"movie", scene.string(), "--frames", "--no-film", "--out", run});
        const Ended ended = run_program(words, {here.path(), {}});
        EXPECT_EQ(ended.status, 0) << ended.err;
        std::vector<fs::path> files(fs::directory_iterator(here / run / "frames"), {});
        std::sort(files.begin(), files.end());
        std::vector<std::string> pictures;
        for (const fs::path& file : files) pictures.push_back(text_of(file));
        return pictures;
    }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

TEST_F(OrbitFilm, LastsAsLongAsTheFilm) {
    const auto whole = frames("whole", {"--set", "film.camera.orbit=180"});
    ASSERT_GT(whole.size(), 5u);
    const double seconds = static_cast<double>(whole.size()) / 30;
    const auto turned_in = [&](const std::string& run, double time) {
        return frames(
            run, {"--set", "film.camera.orbit=180", "--set", fmt::format("film.camera.orbit_time={}", time)});
    };
    EXPECT_EQ(turned_in("told", seconds), whole);
    const auto slower = turned_in("slower", 2 * seconds);
    EXPECT_EQ(slower.front(), whole.front());
    EXPECT_NE(slower.back(), whole.back());
}

// Locked frames that are left out for a bed of two periods do not count in the film's length.
TEST_F(OrbitFilm, LastsAsLongAsTheFilmOfEverySecondPeriod) {
    const auto turned = [&](const std::string& run, std::vector<std::string> more) {
        for (const char* set :
             {"film.camera.orbit=180", "film.periods=2", "film.segment=[{kind=\"locked\"}]"})
            more.insert(more.begin(), {"--set", set});
        return frames(run, more);
    };
    const auto whole = turned("whole", {});
    ASSERT_EQ(whole.size(), 3u);  // after 0, 2 and 4 periods
    const double seconds = static_cast<double>(whole.size()) / 30;
    EXPECT_EQ(turned("told", {"--set", fmt::format("film.camera.orbit_time={}", seconds)}), whole);
}

}  // namespace
}  // namespace grainreel
