// Tests of the charts of studies as their users meet them: keys of [[chart]], and studies with little to
// show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/verbs/study_verb.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string two_keys = replaced(replaced(four_members, "seeds = 2", "seeds = [3]"), "[[measure]]",
                                      "[[vary]]\nkey = \"species.big.diameter\"\nvalues = [\"5 mm\", "
                                      "\"6 mm\"]\n[[measure]]");

// Each key is seen in the chart's picture, its commands or its table.
TEST_F(StudyVerb, KeysOfAChartAreSeenInItsFiles) {
    const std::string keys =
        "[[chart]]\ny = \"kinetic\"\nx = \"species.big.diameter\"\nname = \"energies\"\ntitle = \"Big & "
        "small\"\nx_label = \"size over that of sand\"\ny_label = \"energy in the mean\"\nx_per = \"4 "
        "mm\"\nx_range = [1, 2]\ny_range = [1e-7, \"1 J\"]\nlogarithmic = \"both\"\nseries = [\"Γ = "
        "3\"]\nfont "
        "= \"Liberation Sans\"\nletters = 12\n";
    const Ended ended = run_program(
        words(write(two_keys + keys), {"--no-posters", "--charts", (folder_ / "print").string()}), {});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, Not(HasSubstr("gnuplot")));
    const std::string drawn = text_of(out() / "charts/energies.svg");
    for (const char* seen :
         {"Big &amp; small", "size over that of sand", "energy in the mean (J)", "Liberation Sans"})
        EXPECT_THAT(drawn, HasSubstr(seen));
    EXPECT_THAT(drawn, Not(HasSubstr("Γ = 2")));
    const std::string commands = text_of(out() / "charts/energies.gp");
    for (const char* command : {"set logscale x", "set logscale y", "set xrange [1:2]",
                                "set yrange [1e-07:1]", "'Liberation Sans,21'"})
        EXPECT_THAT(commands, HasSubstr(command));
    const std::string rows = text_of(out() / "charts/energies.csv");
    EXPECT_THAT(rows, AllOf(HasSubstr("\n0,1.25,"), HasSubstr("\n0,1.5,"), HasSubstr("Γ = 3")));
    EXPECT_THAT(rows, Not(HasSubstr("\n1,"))) << "one of the two series";
    EXPECT_THAT(text_of(folder_ / "print/energies.gp"),
                AllOf(HasSubstr("'Liberation Sans,12'"), HasSubstr("size over that of sand")));
    EXPECT_TRUE(fs::exists(folder_ / "print/energies.pdf"));
}

// Words along x have no range, no scale and no division.
TEST_F(StudyVerb, WordsMayStandAlongX) {
    const std::string text = replaced(replaced(replaced(four_members, "drive.g_level", "run.accuracy"),
                                               "[2, 3]", "[\"draft\", \"standard\"]"),
                                      "seeds = 2", "seeds = 1");
    const Ended ended = run_program(words(write(text), {"--no-posters"}), {});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::string drawn = text_of(out() / "charts/kinetic.svg");
    EXPECT_THAT(drawn, AllOf(HasSubstr("draft"), HasSubstr("standard")));
    EXPECT_THAT(text_of(out() / "settings.csv"),
                AllOf(HasSubstr("\ndraft,1,1,"), HasSubstr("\nstandard,1,1,")));
    const auto refused = [&](const std::string& key) {
        const Ended bad = run_program(words(write(text + "[[chart]]\ny = \"kinetic\"\n" + key)), {});
        EXPECT_EQ(bad.status, 2) << key;
        return bad.err;
    };
    EXPECT_THAT(refused("logarithmic = \"x\"\n"), tells({"study.toml:13:1", "logarithmic", "run.accuracy"}));
    EXPECT_THAT(refused("x_range = [0, 1]\n"), tells({"study.toml:13:1", "x_range", "x has words"}));
    EXPECT_THAT(refused("x_per = 2\n"), tells({"study.toml:13:1", "x_per", "x has words"}));
}

// Nothing reaches the threshold: no chart, and words in its place.
TEST_F(StudyVerb, AStudyInWhichNothingCameUpSaysSo) {
    const std::string text =
        replaced(replaced(four_members, "reduce = \"mean\"", "reduce = \"first-passage\"\nthreshold = 1000"),
                 "seeds = 2", "seeds = [5]");
    const Ended ended =
        run_program(words(write(text), {"--no-posters", "--charts", (folder_ / "print").string()}), {});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"kinetic", "came up in 0 of 2"}));
    EXPECT_THAT(ended.err, Not(HasSubstr("gnuplot")));
    EXPECT_THAT(text_of(out() / "settings.csv"),
                AllOf(HasSubstr("\n2,1,1,,,,0,0.1\n"), HasSubstr("\n3,1,1,,,,0,0.1")));
    EXPECT_THAT(text_of(out() / "study.csv"),
                AllOf(HasSubstr("\n2,5,complete,,0,"), HasSubstr("\n3,5,complete,,0,")));
    EXPECT_THAT(text_of(out() / "index.html"), HasSubstr("0 of 1"));
}

// One seed that was chosen by hand has a value and no interval, and runs with that seed.
TEST_F(StudyVerb, OneSeedHasNoInterval) {
    const std::string text = replaced(four_members, "seeds = 2", "seeds = [7]");
    const Ended ended = run_program(words(write(text), {"--no-posters"}), {});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const auto rows = table();
    ASSERT_EQ(rows.size(), 3u);
    for (const std::size_t row : {1, 2}) {
        EXPECT_EQ(rows[row][1], "7");
        EXPECT_EQ(record(out() / rows[row].back())["engine"]["seed"], 7);
    }
    EXPECT_THAT(text_of(out() / "settings.csv"), HasSubstr("\n2,1,1," + rows[1][3] + ",,,1,"));
    EXPECT_THAT(text_of(out() / "charts/kinetic.csv"), HasSubstr("\n0,2," + rows[1][3] + ",NaN,NaN,1,1,"));
    EXPECT_FALSE(fs::exists(out() / "charts/kinetic.seeds.csv"));
    EXPECT_THAT(text_of(out() / "index.html"), HasSubstr("one seed"));
}

}  // namespace
}  // namespace grainreel
