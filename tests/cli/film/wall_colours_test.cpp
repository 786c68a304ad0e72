// Tests of films whose meshes are coloured by pressure or wear. They are the same when drawn from the run,
// from its files and after a stop, and are refused if nobody knows the wear.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/mesh_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

class WallColourFilm : public testing::Test {
  protected:
    WallColourFilm() { write_mesh_scene(here.path()); }
    Ended program(const std::vector<std::string>& words) { return run_program(words, {here.path(), {}}); }
    void movie(const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"movie", "plate.toml", "--no-report", "--out", folder};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = program(words);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    std::vector<std::string> pictures(const std::string& folder) const {
        std::vector<std::string> all;
        for (const auto& entry : fs::directory_iterator(here / folder / "frames"))
            all.push_back(entry.path());
        std::sort(all.begin(), all.end());
        for (std::string& one : all) one = text_of(one);
        return all;
    }
    const std::vector<std::string> coloured{"--set", "film.walls.colour=wear", "--frames"};
    TemporaryFolder here;
};

// Records last 20 ms, and there are frames between their ends; the ball hits the plate at once.
TEST_F(WallColourFilm, IsAlikeFromTheRunAndFromItsFiles) {
    std::vector<std::string> more = coloured;
    for (const char* set : {"output.fields.interval=20 ms", "film.walls.range=[\"1 nJ/m2\", \"1 J/m2\"]"})
        more.insert(more.end(), {"--set", set});
    movie("plate", more);  // the name is the scene's, because its pictures show it
    const Ended render = program({"render", "plate", "--frames", "--out", "again"});
    ASSERT_EQ(render.status, 0) << render.err;
    const std::vector<std::string> run = pictures("plate");
    ASSERT_GE(run.size(), 3u);
    EXPECT_EQ(run == pictures("again"), true);
    ASSERT_EQ(program({"render", "plate", "--frames", "--out", "plain", "--set", "film.walls.colour=plain",
                       "--set", "film.words=none"})
                  .status,
              0);
    ASSERT_EQ(program({"render", "plate", "--frames", "--out", "bare", "--set", "film.words=none"}).status,
              0);
    EXPECT_EQ(pictures("plain") == pictures("bare"), false);
}

TEST_F(WallColourFilm, GoesOnAfterTheRunWasBrokenOff) {
    std::vector<std::string> more = coloured;
    more.insert(more.end(), {"--set", "film.walls.range=[\"1 nJ/m2\", \"1 J/m2\"]", "--set",
                             "output.fields.interval=15 ms"});
    movie("whole", more);
    std::vector<std::string> half = more;
    half.insert(half.end(), {"--duration", "50 ms"});
    movie("run", half);
    const Ended ended = program({"resume", "run", "--for", "50 ms", "--no-report"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(pictures("run") == pictures("whole"), true);
}

TEST_F(WallColourFilm, IsCompared) {
    movie("one", coloured);
    movie("other", {"--set", "film.walls.colour=wear", "--set", "contact.friction=0.1", "--frames"});
    const Ended ended = program({"compare", "one", "other", "--out", "both", "--size", "480x270"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_TRUE(fs::exists(here / "both/poster.png"));
}

TEST_F(WallColourFilm, IsRefusedWhereNobodyKnowsTheWear) {
    movie("run", {"--no-film"});
    const Ended render = program({"render", "run", "--at", "0.05", "--set", "film.walls.colour=wear"});
    EXPECT_EQ(render.status, 2);
    EXPECT_THAT(render.err, HasSubstr("fields.nc"));
    EXPECT_THAT(render.err, HasSubstr("--set film.walls.colour=plain"));
    EXPECT_EQ(std::count(render.err.begin(), render.err.end(), '\n'), 1) << render.err;
}

TEST_F(WallColourFilm, WantsMeshesAndARangeThatRises) {
    write_small_scene(here.path());
    const Ended none = program({"check", "fifty.toml", "--set", "film.walls.colour=pressure"});
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.err, tells({"film.walls.colour", "'colour'", "meshes", "none"}));
    const Ended falls = program({"check", "plate.toml", "--set", "film.walls.colour=pressure", "--set",
                                 "film.walls.range=[\"2 kPa\", \"1 kPa\"]"});
    EXPECT_EQ(falls.status, 2);
    EXPECT_THAT(falls.err, HasSubstr("must rise"));
    const Ended plain = program({"check", "plate.toml", "--set", "film.walls.range=[\"1 Pa\", \"1 kPa\"]"});
    EXPECT_EQ(plain.status, 2);
    EXPECT_THAT(plain.err, HasSubstr("walls are plain"));
}

}  // namespace
}  // namespace grainreel
