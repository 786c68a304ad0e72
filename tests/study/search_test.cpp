// Tests of the search for a key's value: where bisection leads, and when it stops.
#include "render/app/study/results/search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/base/error.hpp"
#include "tests/study/study_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using Verdict = SearchStep::Verdict;

SeedSummary with_interval(double mean, double half) {
    SeedSummary y;
    y.members = y.count = 3;
    y.value = mean, y.low = mean - half, y.high = mean + half;
    return y;
}

SeedSummary of_one_seed(double value) {
    SeedSummary y;
    y.members = y.count = 1;
    y.value = value;
    return y;
}

// Runs the search from 0 to 8 to its end.
SearchStep searched(const std::function<SeedSummary(double)>& measure, double wanted, double within,
                    std::size_t* runs = nullptr) {
    std::vector<TriedValue> tried{{0, measure(0)}, {8, measure(8)}};
    SearchStep step = next_step(tried, wanted, within);
    while (step.verdict == Verdict::go_on && tried.size() < 50) {
        tried.push_back({step.next, measure(step.next)});
        step = next_step(tried, wanted, within);
    }
    if (runs != nullptr) *runs = tried.size();
    return step;
}

// x^2 = 10 at 3.1623: eight halvings bring 8 below 0.04.
TEST(StudySearch, HalvesTheBracketUntilItIsNarrow) {
    std::size_t runs = 0;
    const SearchStep step = searched([](double x) { return of_one_seed(x * x); }, 10, 0.04, &runs);
    EXPECT_EQ(step.verdict, Verdict::reached);
    EXPECT_NEAR(step.estimate, std::sqrt(10.0), 1e-3);
    EXPECT_LE(step.high - step.low, 0.04);
    EXPECT_EQ(runs, 2u + 8);
    const SearchStep falling = searched([](double x) { return of_one_seed(-x * x); }, -10, 0.04);
    EXPECT_NEAR(falling.estimate, std::sqrt(10.0), 1e-3);
}

TEST(StudySearch, StopsWhereTheSeedsCannotTell) {
    const SearchStep step = searched([](double x) { return with_interval(x, 0.3); }, 3.1, 0.01);
    EXPECT_EQ(step.verdict, Verdict::seeds_too_few);
    EXPECT_LE(step.low, 3.1);
    EXPECT_GE(step.high, 3.1);
    // y = x: the interval of the value reaches as far along x.
    EXPECT_NEAR(step.high - step.low, 0.6, 1e-9);
    EXPECT_NEAR(step.estimate, 3.1, 1e-9);
    EXPECT_THAT(search_text(step, "k", "mm", true), tells({"stopped", "give more seeds"}));
}

TEST(StudySearch, StopsWhereTheMeasureTurns) {
    const SearchStep step =
        searched([](double x) { return with_interval(x < 5 ? 2 * x : 20 - 2 * x, 0.01); }, 3, 0.01);
    EXPECT_EQ(step.verdict, Verdict::not_monotonic);
    EXPECT_THAT(search_text(step, "k", "", true), tells({"stopped", "rises and falls"}));
}

// With one seed a value out of order is scatter: the search goes on, and says so.
TEST(StudySearch, OfOneSeedGoesOnWhereValuesScatter) {
    const auto scattered = [](double x) { return of_one_seed(x == 6 ? 9 : x); };
    const SearchStep step =
        next_step({{0, scattered(0)}, {4, scattered(4)}, {6, scattered(6)}, {8, scattered(8)}}, 4.5, 2);
    EXPECT_EQ(step.verdict, Verdict::reached);
    EXPECT_EQ(step.low, 4);
    EXPECT_EQ(step.high, 6);
    EXPECT_THAT(search_text(step, "k", "", false), tells({"between 4 and 6", "more seeds"}));
}

// What a wider `within` answered is answered by a narrower one too.
TEST(StudySearch, TellsTheBracketWhereTheMeasureTurns) {
    const auto measure = [](double x) { return with_interval(x < 5 ? 2 * x : 20 - 2 * x, 0.01); };
    const std::vector<TriedValue> tried{{0, measure(0)}, {4, measure(4)}, {8, measure(8)}};
    EXPECT_EQ(next_step(tried, 3, 4).verdict, Verdict::reached);
    const SearchStep narrower = next_step(tried, 3, 1);
    EXPECT_EQ(narrower.verdict, Verdict::not_monotonic);
    EXPECT_THAT(search_text(narrower, "k", "", true), tells({"between 0 and 8", "between 0 and 4"}));
}

// An end of the range is no bound of the value.
TEST(StudySearch, IsOpenWhereTheIntervalLeavesTheRange) {
    const SearchStep step = next_step({{0, with_interval(0, 1)}, {8, with_interval(8, 1)}}, 7.5, 0.1);
    EXPECT_EQ(step.verdict, Verdict::seeds_too_few);
    EXPECT_TRUE(step.open_high);
    EXPECT_FALSE(step.open_low);
    EXPECT_THAT(search_text(step, "k", "mm", true), tells({"at least 6.5 mm", "wider range"}));
    StudySearch search;
    EXPECT_THAT(search_json(search, step, "k", "mm", StudyMeasure()),
                testing::AllOf(testing::HasSubstr("\"high\": null"), testing::HasSubstr("\"low\": 6.5")));
}

TEST(StudySearch, SaysThatTheValueIsOutside) {
    EXPECT_EQ(searched([](double x) { return of_one_seed(x); }, 9, 0.1).verdict, Verdict::not_in_range);
    EXPECT_EQ(searched([](double x) { return of_one_seed(x); }, -1, 0.1).verdict, Verdict::not_in_range);
}

TEST(StudySearch, StopsWhereAMeasureDidNotComeUp) {
    SeedSummary some = of_one_seed(1);
    some.members = 2, some.value = SeedSummary::kNone;
    EXPECT_EQ(next_step({{0, some}, {8, of_one_seed(3)}}, 2, 0.1).verdict, Verdict::unknown);
}

const std::string searching = R"(scene = "fifty.toml"
seeds = 2
[[vary]]
key = "contact.friction"
from = 0.1
to = 0.9
until = "energy = 0.5"
within = 0.05
[[measure]]
name = "energy"
column = "kinetic"
reduce = "mean"
)";

TEST(StudySearch, IsReadFromVary) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(searching);
    ASSERT_TRUE(study.search);
    EXPECT_EQ(study.search->wanted, 0.5);
    EXPECT_EQ(study.search->within, 0.05);
    EXPECT_EQ(study.variations[0].values.size(), 2u) << "both ends come first";
    Study longer = study;
    longer.try_value(0.5);
    ASSERT_EQ(longer.variations[0].values.size(), 3u);
    EXPECT_EQ(longer.variations[0].values[1].toml, "0.5") << "values stay in order";
}

TEST(StudySearch, IsRefusedByNameWhenWrong) {
    const StudyFolderOfTest folder;
    const auto refusal = [&](const std::string& line, const std::string& other) -> std::string {
        try {
            folder.read(with_line(searching, line, other));
        } catch (const UserError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal("energy = 0.5", "energy"), tells({":7:", "until", "="}));
    EXPECT_THAT(refusal("energy = 0.5", "speed = 0.5"), tells({":7:", "speed", "energy"}));
    EXPECT_THAT(refusal("energy = 0.5", "energy = 5 s"), tells({":7:", "until"}));
    EXPECT_THAT(refusal("within = 0.05\n", ""), tells({"within"}));
    EXPECT_THAT(refusal("within = 0.05", "within = -1"), tells({"within", "larger than 0"}));
    EXPECT_THAT(refusal("to = 0.9", "to = 0.9\ncount = 5"), tells({"count", "until"}));
    EXPECT_THAT(refusal("from = 0.1", "from = 0.9"), tells({"from", "to"}));
    EXPECT_THAT(refusal("[[measure]]", "[[vary]]\nkey = \"drive.g_level\"\nvalues = [2, 3]\n[[measure]]"),
                tells({"until", "one [[vary]]"}));
    EXPECT_THAT(refusal("until = \"energy = 0.5\"\n", ""), tells({"within", "until"}));
}

}  // namespace
}  // namespace grainreel
