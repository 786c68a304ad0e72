// Tests of runs that continue from another run's checkpoint, as the user starts them: check and movie agree,
// and a refusal leaves nothing behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

class ContinuedMovie : public testing::Test {
  protected:
    void SetUp() override {
        write_small_scene(here.path());
        const Ended first = run({"movie", "fifty.toml", "--no-film", "--out", "run", "--duration", "0.05 s"});
        ASSERT_EQ(first.status, 0) << first.err;
    }
    Ended run(const std::vector<std::string>& words) const { return run_program(words, {here.path(), {}}); }
    Ended go_on(const std::string& verb, const std::vector<std::string>& more) const {
        std::vector<std::string> words = {verb,         "run/scene.toml",
                                          "--set",      "start.method=file",
                                          "--set",      "start.file=checkpoint.grs",
                                          "--set",      "start.keep_clock=true",
                                          "--duration", "0.1 s"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    std::string state_hash(const char* folder) const {
        return nlohmann::json::parse(text_of(here / folder / "run.json"))["engine"]["state_hash"]
            .get<std::string>();
    }

    TemporaryFolder here;
};

TEST_F(ContinuedMovie, IsTheSameRunAlsoInItsOwnFolder) {
    const Ended whole =
        run({"movie", "run/scene.toml", "--no-film", "--out", "whole", "--duration", "0.1 s"});
    ASSERT_EQ(whole.status, 0) << whole.err;
    EXPECT_EQ(go_on("check", {}).status, 0);
    const Ended on = go_on("movie", {"--no-film", "--out", "run", "--force"});
    ASSERT_EQ(on.status, 0) << on.err;
    EXPECT_EQ(state_hash("run"), state_hash("whole"));
}

TEST_F(ContinuedMovie, CheckSaysWhatHappensToABedFromAFile) {
    const auto line = [&](const char* file, const std::string& law) {
        const Ended check = run({"check", "fifty.toml", "--set", "start.method=file", "--set",
                                 std::string("start.file=run/") + file, "--set", "contact.law=" + law});
        EXPECT_EQ(check.status, 0) << check.err;
        const auto at = check.out.find("\nstart ");
        return at == std::string::npos ? check.out
                                       : check.out.substr(at + 1, check.out.find('\n', at + 1) - at);
    };
    // These are checkpoints of the packed bed, and of the bed while it is shaken.
    const char *rests = "checkpoints/000000000000.grs", *moves = "checkpoint.grs";
    EXPECT_THAT(line(rests, "walton-braun"),
                tells({"stiffness", "in the file's run", "keep their histories"}));
    EXPECT_THAT(line(rests, "hertz"),
                tells({"begin anew", "law", "not that", "rests in the file", "before time 0"}));
    EXPECT_THAT(line(moves, "hertz"), HasSubstr("; nothing is damped, for "));
    EXPECT_THAT(line("final.csv", "walton-braun"), tells({"begin anew", "table", "no histories"}));
}

TEST_F(ContinuedMovie, CheckRefusesWhatMovieRefuses) {
    const std::vector<std::string> change = {"--set", "drive.direction=[1, 0, 0]"};
    const Ended check = go_on("check", change);
    EXPECT_EQ(check.status, 2);
    EXPECT_EQ(check.out, "");
    EXPECT_THAT(check.err,
                tells({"error: --set drive.direction", "'drive.direction'", "[1.0, 0.0, 0.0], but"}));
    const Ended movie = go_on("movie", {change[0], change[1], "--out", "new"});
    EXPECT_EQ(movie.status, 2);
    EXPECT_EQ(movie.err, check.err);
    EXPECT_FALSE(fs::exists(here / "new"));
}

}  // namespace
}  // namespace grainreel
