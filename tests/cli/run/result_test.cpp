// Tests of what happens when the program cannot print its result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

// Every write to /dev/full fails: the disk is full.
TEST(Result, ThatCannotBeWrittenIsAFailure) {
    const TemporaryFolder here;
    const std::string scene = write_small_scene(here.path()).string();
    const std::vector<std::vector<std::string>> commands{
        {"--version"},
        {"--help"},
        {"movie", "--help"},
        {"check", scene},
        {"movie", scene, "--no-film", "--out", "run"},
        {"movie", scene, "--no-film", "--progress", "json", "--out", "run2"},
        {"render", "run", "--at", "0", "--out", "still.png"},
        {"render", "run", "--size", "640x360", "--out", "again"},
        {"compare", "run", "run2", "--size", "640x360", "--out", "both"},
        {"bench", "gas", "--quick", "--json", "--particles", "500", "--threads", "1"}};
    for (const std::vector<std::string>& words : commands) {
        const Ended ended = run_program(words, {.folder = here.path(), .out = "/dev/full"});
        EXPECT_EQ(ended.status, 1) << words[0];
        EXPECT_THAT(ended.err, tells({"stdout", "cannot be written", "No space left"})) << words[0];
    }
    EXPECT_EQ(nlohmann::json::parse(text_of(here / "run/run.json"))["status"], "complete");
}

// `inspect RUN | head` closes the pipe in this way.
TEST(Result, AReaderThatHasSeenEnoughIsNoFailure) {
    const TemporaryFolder here;
    const std::string scene = write_small_scene(here.path()).string();
    const std::vector<std::vector<std::string>> commands{
        {"--help"},
        {"inspect", "--help"},
        {"check", scene},
        {"scenes"},
        {"movie", scene, "--no-film", "--no-report", "--out", "run"},
        {"inspect", "run"},
        {"inspect", "run", "--where", "id >= 0", "--limit", "1000", "--csv"},
        {"render", "run", "--at", "0", "--out", "still.png"},
        {"report", "run"}};
    for (const std::vector<std::string>& words : commands) {
        const Ended ended = run_program(words, {.folder = here.path(), .out_closed = true});
        EXPECT_EQ(ended.status, 0) << words[0];
        EXPECT_THAT(ended.err, Not(HasSubstr("stdout"))) << words[0];
    }
    EXPECT_EQ(nlohmann::json::parse(text_of(here / "run/run.json"))["status"], "complete");
}

TEST(Result, AMistakeStaysAMistake) {
    const TemporaryFolder here;
    const Ended ended = run_program({"check", "missing.toml"}, {.folder = here.path(), .out = "/dev/full"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, HasSubstr("missing.toml"));
}

}  // namespace
}  // namespace grainreel
