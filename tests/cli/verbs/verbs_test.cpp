// Tests of the table of verbs, and of --help, which is made from it.
#include "render/app/verbs/verbs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include <fmt/format.h>

#include "tests/cli/program.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

std::string help(std::vector<std::string> words) {
    words.push_back("--help");
    const Ended ended = run_program(words, {});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.out;
}

TEST(Verbs, StandInHelpWithWhatTheyAreAbout) {
    const std::string all = help({});
    std::size_t last = 0;
    for (const auto& verb : all_verbs()) {
        const std::size_t at = all.find("\n  " + verb->name() + " ");
        ASSERT_NE(at, std::string::npos) << verb->name();
        EXPECT_GT(at, last) << "order of the table";
        last = at;
        EXPECT_THAT(all.substr(at, all.find('\n', at + 1) - at), HasSubstr(verb->about()));
        const std::string own = help({verb->name()});
        EXPECT_THAT(own, HasSubstr(verb->about()));
        EXPECT_THAT(own, HasSubstr(verb->footer()));
        EXPECT_THAT(verb->footer(), HasSubstr("Exit status: 0 "));
    }
}

TEST(Verbs, AreNamedToWhoTypesAnother) {
    const Ended ended = run_program({"moovie"}, {});
    EXPECT_EQ(ended.status, 2);
    std::string names;
    for (const auto& verb : all_verbs()) names += (names.empty() ? "" : ", ") + verb->name();
    EXPECT_EQ(ended.err, "error: unknown command 'moovie'; did you mean 'movie'? there are " + names +
                             "; see grainreel --help\n");
    EXPECT_THAT(run_program({"gravel.toml"}, {}).err, HasSubstr("did you mean 'movie gravel.toml'?"));
    EXPECT_THAT(run_program({"xylophone"}, {}).err, tells({"unknown command", "'xylophone'", "movie"}));
}

TEST(Verbs, NameTheOptionThatWasMeant) {
    const Ended ended = run_program({"movie", "a.toml", "--duratoin", "3s", "--nofilm"}, {});
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.err,
              "error: unknown option '--duratoin'; did you mean '--duration'? see grainreel movie --help\n");
    EXPECT_EQ(run_program({"check", "a.toml", "--xylophone=1"}, {}).err,
              "error: unknown option '--xylophone'; see grainreel check --help\n");
}

TEST(Verbs, ShowTheirOwnHelpToAMistake) {
    EXPECT_THAT(run_program({"movie", "a.toml", "--seed"}, {}).err,
                HasSubstr("; see grainreel movie --help"));
    EXPECT_THAT(run_program({"render"}, {}).err, tells({"RUN is required", "grainreel render --help"}));
    EXPECT_THAT(run_program({"--no-such"}, {}).err, HasSubstr("; see grainreel --help"));
}

TEST(Verbs, AreNamedAsTheUserCallsTheProgram) {
    const Program::Setting by_script{".", {"GRAINREEL_CALLED=../a tree/movie"}};
    EXPECT_THAT(run_program({"render"}, by_script).err,
                tells({"RUN is required", "'../a tree/movie' render --help"}));
    EXPECT_THAT(run_program({"moovie"}, by_script).err, HasSubstr("see '../a tree/movie' --help"));
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--help"}, {"new", "--help"}, {"inspect", "--help"}}) {
        const std::string help = run_program(words, by_script).out;
        EXPECT_THAT(help, HasSubstr("'../a tree/movie' "));
        EXPECT_THAT(help, testing::Not(HasSubstr("grainreel ")));
    }
}

// With so small a stack the program, or one of its threads, ended without a word.
TEST(SmallStack, IsTold) {
    const TemporaryFolder here;
    const std::string command =
        fmt::format("ulimit -s 200 && '{}' scenes 2> '{}'", GRAINREEL_BINARY, (here / "said").string());
    EXPECT_EQ(WEXITSTATUS(std::system(("sh -c \"" + command + "\"").c_str())), 2);
    EXPECT_THAT(text_of(here / "said"), tells_only({"stack", "200 kB", "ulimit -s"}));
}

}  // namespace
}  // namespace grainreel
