// Tests of the words after options, before anything is made of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;

// A folder with such a name was made once, though no message or run.json can name it.
TEST(Options, FoldersAreNamedInUtf8) {
    const TemporaryFolder here;
    const std::string scene = write_small_scene(here.path()).string();
    const std::vector<std::vector<std::string>> commands = {
        {"movie", scene, "--no-film", "--duration", "1 ms"},
        {"chart", "savings", "--quick"},
        {"bench", "render"}};
    for (std::vector<std::string> words : commands) {
        words.insert(words.end(), {"--out", "a\xff"});
        const Ended ended = run_program(words, {here.path()});
        EXPECT_EQ(ended.status, 2) << words.front();
        EXPECT_EQ(ended.err,
                  "error: --out: \"a\\xff\" is not UTF-8 at byte 2, 0xff; type it in a UTF-8 terminal\n");
    }
    const Ended named = run_program({"movie", scene}, {here.path(), {"GRAINREEL_OUTPUT=\xff"}});
    EXPECT_EQ(named.status, 2);
    EXPECT_THAT(named.err, testing::HasSubstr("GRAINREEL_OUTPUT: \"\\xff\" is not UTF-8 at byte 1"));
}

// Each option that is a time takes it as a scene does, and as a plain number in s.
TEST(Options, TimesMayHaveUnits) {
    const TemporaryFolder here;
    write_small_scene(here.path());
    const auto said = [&](std::vector<std::string> words, const std::string& flag, const std::string& time) {
        words.insert(words.end(), {flag, time});
        return run_program(words, {here.path()}).err;
    };
    const std::vector<std::pair<std::vector<std::string>, std::string>> options = {
        {{"render", "gone"}, "--at"},  {{"render", "gone"}, "--from"},
        {{"render", "gone"}, "--to"},  {{"render", "gone", "--follow"}, "--idle"},
        {{"inspect", "gone"}, "--at"}, {{"export", "gone", "--to", "csv"}, "--until"},
        {{"resume", "gone"}, "--for"}, {{"compare", "gone", "gone"}, "--at"},
    };
    for (const auto& [words, flag] : options) {
        for (const char* time : {"0.5", "0.5s", "0.5 s", "500ms"})
            EXPECT_THAT(said(words, flag, time), testing::StartsWith("error: gone: ")) << flag << " " << time;
        EXPECT_THAT(said(words, flag, "3 kg"),
                    testing::HasSubstr(flag + " must be a time, but \"3 kg\" is a mass"));
    }
    for (const char* time : {"0.5", "0.5s", "0.5 s", "500ms"})
        EXPECT_EQ(run_program({"check", "fifty.toml", "--duration", time}, {here.path()}).status, 0) << time;
    EXPECT_EQ(said({"render", "gone", "--follow"}, "--idle", "100 ms"),
              "error: --idle: must be a time from 0.5 s to 1000000 s, but is 0.1 s\n");
}

}  // namespace
}  // namespace grainreel
