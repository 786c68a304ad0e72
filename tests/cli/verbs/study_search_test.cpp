// Tests of `[[vary]] until` as its users meet it: the search runs, stops, goes on, and is gathered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>

#include "tests/cli/verbs/study_verb.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

std::string searching(const std::string& wanted, const std::string& within = "1") {
    return replaced(
        replaced(replaced(four_members, "values = [2, 3]",
                          "from = 1\nto = 5\nuntil = \"kinetic = " + wanted + "\"\nwithin = " + within),
                 "seeds = 2", "seeds = 1"),
        "run.duration=0.1 s", "run.duration=0.05 s");
}

// The kinetic energy rises with the shaking, so the search comes to its bracket.
TEST_F(StudyVerb, SearchesAValue) {
    const std::string study = write(searching("1"));
    const Ended outside = run_program(words(study, {"--no-posters"}), {});
    ASSERT_EQ(outside.status, 0) << outside.err;
    EXPECT_THAT(outside.err, tells({"search", "both ends"}));
    ASSERT_EQ(table().size(), 3u);
    const double low = std::stod(table()[1][3]), high = std::stod(table()[2][3]);
    ASSERT_LT(low, high);
    const std::string inside = replaced(text_of(folder_ / "study.toml"), "kinetic = 1",
                                        fmt::format("kinetic = {}", 0.5 * (low + high)));
    const Ended found = run_program(words(write(inside), {"--no-posters"}), {});
    ASSERT_EQ(found.status, 0) << found.err;
    EXPECT_EQ(table().size(), 5u) << "1, 5, and two middles";
    EXPECT_THAT(found.err, tells({"search: Γ =", "one seed"}));
    EXPECT_THAT(text_of(out() / "index.html"), HasSubstr("Search: "));
    const std::string rows = text_of(out() / "settings.csv");
    const Ended again = run_program(words(write(inside), {"--no-posters"}), {});
    EXPECT_EQ(text_of(out() / "settings.csv"), rows);
    EXPECT_THAT(again.err, HasSubstr("search: Γ ="));
}

// The measure between those of both ends, so that the search has a middle to find.
std::string between_the_ends(const std::vector<std::vector<std::string>>& ends) {
    return fmt::format("{}", 0.5 * (std::stod(ends.at(1)[3]) + std::stod(ends.at(2)[3])));
}

// The commands of the next values are printed, run elsewhere and gathered, until the value is found. This
// comes to the same table as the search that runs by itself.
TEST_F(StudyVerb, ASearchIsRunElsewhereAndGathered) {
    ASSERT_EQ(run_program(words(write(searching("1")), {"--no-posters"}), {}).status, 0);
    const std::string study = write(searching(between_the_ends(table())));
    ASSERT_EQ(run_program(words(study, {"--no-posters"}), {}).status, 0);
    const std::string wanted = text_of(out() / "study.csv");
    ASSERT_EQ(table().size(), 5u);
    fs::remove_all(out());
    std::vector<std::ptrdiff_t> commands;
    Ended gathered;
    for (int turn = 0; turn < 5; ++turn) {
        const Ended printed = run_program(words(study, {"--print-commands"}), {});
        ASSERT_EQ(printed.status, 0) << printed.err;
        if (printed.out.empty()) break;
        commands.push_back(std::count(printed.out.begin(), printed.out.end(), '\n'));
        write_text(folder_ / "commands.txt", printed.out);
        ASSERT_EQ(std::system(("sh '" + (folder_ / "commands.txt").string() + "' > /dev/null 2>&1").c_str()),
                  0);
        gathered = run_program(words(study, {"--collect"}), {});
        ASSERT_EQ(gathered.status, 0) << gathered.err;
        if (turn == 0) {
            EXPECT_THAT(gathered.err, tells({"search: ", "next is 3"}));
        }
    }
    EXPECT_THAT(commands, testing::ElementsAre(2, 1, 1)) << "both ends, and two middles";
    EXPECT_THAT(gathered.err, tells({"search: Γ =", "one seed"}));
    EXPECT_EQ(text_of(out() / "study.csv"), wanted);
}

// Ctrl-C while a middle runs: the same command goes on with that search, and comes to the same end.
TEST_F(StudyVerb, ASearchThatWasStoppedGoesOn) {
    ASSERT_EQ(run_program(words(write(searching("1")), {"--no-posters"}), {}).status, 0);
    const std::string study = write(searching(between_the_ends(table()), "0.25"));
    Program program(words(study, {"--jobs", "1", "--no-posters"}), {});
    ASSERT_TRUE(wait_until(program, [&] { return members().size() > 2; }));
    program.send(SIGINT);
    const Ended ended = program.wait();
    ASSERT_EQ(ended.status, 130) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("the same command goes on"));
    const std::size_t begun = members().size();
    EXPECT_LT(begun, 6u) << "stopped too late to tell";
    const Ended on = run_program(words(study, {"--no-posters"}), {});
    ASSERT_EQ(on.status, 0) << on.err;
    EXPECT_THAT(on.err, HasSubstr("search: Γ ="));
    const std::string found = text_of(out() / "settings.csv");
    EXPECT_EQ(table().size(), 7u) << "1, 5, and four middles";
    fs::remove_all(out());
    ASSERT_EQ(run_program(words(study, {"--no-posters"}), {}).status, 0);
    EXPECT_EQ(text_of(out() / "settings.csv"), found);
}

}  // namespace
}  // namespace grainreel
