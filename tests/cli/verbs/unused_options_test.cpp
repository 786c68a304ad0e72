// An option has an effect, or it is refused by its name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
namespace fs = std::filesystem;

class UnusedOptions : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        here = new TemporaryFolder;
        write_small_scene(here->path());
        const Ended run = run_program(
            {"movie", "fifty.toml", "--no-film", "--no-report", "--duration", "1 ms", "--out", "run"},
            {here->path()});
        ASSERT_EQ(run.status, 0) << run.err;
    }
    static void TearDownTestSuite() { delete here; }

    static Ended program(const std::vector<std::string>& words) { return run_program(words, {here->path()}); }
    // The words are refused in one line that tells the option, and nothing is made.
    static void expect_refused(const std::vector<std::string>& words, const std::string& option) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(words);
        EXPECT_THAT(ended.err, tells({option})) << testing::PrintToString(words);
        EXPECT_FALSE(fs::exists(*here / "x.png")) << testing::PrintToString(words);
    }

    static TemporaryFolder* here;
};
TemporaryFolder* UnusedOptions::here = nullptr;

// They are of a film, and --png draws one picture.
TEST_F(UnusedOptions, OfAFilmAtAPicture) {
    for (const std::vector<std::string>& option : {std::vector<std::string>{"--format", "gif"},
                                                   {"--sheet", "3x3"},
                                                   {"--max-size", "1MB"},
                                                   {"--fps", "5"}}) {
        std::vector<std::string> words = {"inspect", "run", "--png", "x.png"};
        words.insert(words.end(), option.begin(), option.end());
        expect_refused(words, option.front());
    }
    for (const char* set : {"film.format=gif", "film.sheet=\"3x3\"", "film.max_size=\"1MB\"", "film.rate=5"})
        expect_refused({"inspect", "run", "--png", "x.png", "--set", set}, std::string(set).substr(0, 8));
    EXPECT_EQ(program({"inspect", "run", "--png", "clear.png", "--transparent", "--size", "160x120"}).status,
              0);
}

TEST_F(UnusedOptions, WithoutThePartThatTheyAreOf) {
    expect_refused({"inspect", "run", "--gl", "osmesa"}, "--gl");
    expect_refused({"compare", "run", "run", "--no-cache"}, "--no-cache");
    expect_refused({"compare", "fifty.toml", "fifty.toml", "--no-replay"}, "--no-replay");
    expect_refused({"resume", "run", "--no-film", "--gl", "osmesa"}, "--gl");
    for (const char* option : {"--films", "--retry", "--no-cache"})
        expect_refused({"study", "gone.toml", "--collect", option}, option);
    expect_refused({"movie", "fifty.toml", "--watch-host", "localhost"}, "--watch-host");
}

// The name of a film or a picture is none of the folder in which it is made.
TEST_F(UnusedOptions, AFolderHasNoNameOfAFilm) {
    expect_refused({"compare", "run", "run", "--at", "0", "--out", "x.png"}, "--out x.png");
    expect_refused({"movie", "fifty.toml", "--out", "film.mp4"}, "--out film.mp4");
    expect_refused({"render", "run", "--out", "film.gif"}, "--out film.gif");
    EXPECT_FALSE(fs::exists(*here / "film.mp4"));
}

}  // namespace
}  // namespace grainreel
