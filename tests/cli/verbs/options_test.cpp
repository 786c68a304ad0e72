// Tests of the words after options, before anything is made of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "tests/cli/small_scene.hpp"
#include "tests/cli/temporary_folder.hpp"

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

}  // namespace
}  // namespace grainreel
