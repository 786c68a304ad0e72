// Tests of what the seeds of a setting say together, above all where a measure came up in some of them only.
#include "render/app/study/results/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/app/study/page.hpp"
#include "render/app/study/results/drawing.hpp"
#include "tests/study/study_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

constexpr double nan = SeedSummary::kNone;

// Seeds that came up at these times, and others that did not until `until`.
std::vector<SeedValue> passages(const std::vector<double>& times, std::size_t others, double until) {
    std::vector<SeedValue> seeds;
    for (const double time : times) seeds.push_back({time, nan});
    for (std::size_t i = 0; i < others; ++i) seeds.push_back({nan, until});
    return seeds;
}

// One of five rose after 1 s, the others not within 3 s: the mean is at least (1 + 4 * 3) / 5 s.
TEST(SeedSummaries, AMeanOfSomePassagesIsABound) {
    const SeedSummary all = summary_of(SeedAverage::mean, passages({1}, 4, 3));
    EXPECT_EQ(all.count, 1u);
    EXPECT_EQ(all.members, 5u);
    EXPECT_TRUE(std::isnan(all.value));
    EXPECT_TRUE(std::isnan(all.low));
    EXPECT_TRUE(all.is_bound);
    EXPECT_DOUBLE_EQ(all.of_some, (1 + 4 * 3) / 5.0);
    EXPECT_EQ(summary_text(all), "≥ 2.6");
    EXPECT_EQ(came_up_text(all), "came up in 1 of 5");
}

// Nothing is known of values that are missing for another reason.
TEST(SeedSummaries, OtherGapsGiveNoBound) {
    const SeedSummary some = summary_of(SeedAverage::mean, {{2, nan}, {4, nan}, {nan, nan}});
    EXPECT_TRUE(std::isnan(some.value));
    EXPECT_FALSE(some.is_bound);
    EXPECT_EQ(some.of_some, 3);
    EXPECT_EQ(summary_text(some), "(3)");
    const SeedSummary none = summary_of(SeedAverage::mean, {{nan, nan}, {nan, nan}});
    EXPECT_FALSE(none.is_seen());
    EXPECT_EQ(summary_text(none), "–");
    EXPECT_EQ(came_up_text(none), "came up in 0 of 2");
}

// The median of 1, 2, 3 and two later ones is 3; of 1, 2 and three later ones it is later than 5.
TEST(SeedSummaries, AMedianIsKnownWhileHalfCameUp) {
    const SeedSummary known = summary_of(SeedAverage::median, passages({3, 1, 2}, 2, 5));
    EXPECT_EQ(known.value, 3);
    EXPECT_TRUE(std::isnan(known.low)) << "five seeds have no 95 % interval of the median";
    const SeedSummary later = summary_of(SeedAverage::median, passages({1, 2}, 3, 5));
    EXPECT_TRUE(std::isnan(later.value));
    EXPECT_TRUE(later.is_bound);
    EXPECT_EQ(later.of_some, 5);
}

// P(the median lies outside of all six) = 2 / 2^6 = 3.1 %; of eight without the outermost 2 (1 + 8) / 2^8 = 7
// %.
TEST(SeedSummaries, TheIntervalOfAMedianIsThatOfItsOrder) {
    const SeedSummary six = summary_of(SeedAverage::median, passages({6, 5, 4, 3, 2, 1}, 0, 0));
    EXPECT_EQ(six.value, 3.5);
    EXPECT_EQ(six.low, 1);
    EXPECT_EQ(six.high, 6);
    const SeedSummary open = summary_of(SeedAverage::median, passages({1, 2, 3, 4, 5, 6, 7}, 1, 9));
    EXPECT_EQ(open.low, 1);
    EXPECT_TRUE(std::isinf(open.high));
    EXPECT_EQ(summary_text(open), "4.5 (1 to ∞)");
    const SeedSummary nine = summary_of(SeedAverage::median, passages({1, 2, 3, 4, 5, 6, 7, 8, 9}, 0, 0));
    EXPECT_EQ(nine.low, 2) << "2 (1 + 9) / 2^9 = 3.9 %";
    EXPECT_EQ(nine.high, 8);
}

// Wilson's interval of 5 of 5 with z = 1.96 reaches down to n / (n + z^2).
TEST(SeedSummaries, AShareHasWilsonsInterval) {
    const SeedSummary all =
        summary_of(SeedAverage::share, {{1, nan}, {1, nan}, {1, nan}, {1, nan}, {1, nan}});
    const double z = 1.959963984540054;
    EXPECT_EQ(all.value, 1);
    EXPECT_NEAR(all.low, 5 / (5 + z * z), 1e-12);
    EXPECT_EQ(all.high, 1);
    const SeedSummary half = summary_of(SeedAverage::share, {{1, nan}, {0, nan}});
    EXPECT_NEAR(0.5 - half.low, half.high - 0.5, 1e-12);
    EXPECT_TRUE(half.values.empty()) << "no ring at 0 and at 1";
}

// 1.1 \u00b1 t_1 (0.9) reaches below zero, which a time cannot.
TEST(SeedSummaries, OfTimesEndAtZero) {
    StudyMeasure time;
    const std::vector<SeedValue> seeds{{0.2, nan}, {2, nan}};
    EXPECT_LT(summary_of_measure(time, seeds).low, 0);
    time.from_zero = true;
    const SeedSummary all = summary_of_measure(time, seeds);
    EXPECT_EQ(all.low, 0);
    EXPECT_TRUE(all.cut_at_zero);
    EXPECT_THAT(summary_text(all), testing::StartsWith("1.1 (0 to "));
}

TEST(SeedSummaries, HaveTheSameDigitsInAColumn) {
    std::vector<SeedSummary> column(3);
    column[0].value = -0.34, column[1].value = -0.312, column[2].value = 2;
    EXPECT_THAT(column_texts(column), testing::ElementsAre("\u22120.340", "\u22120.312", "2.000"));
}

TEST(SeedSummaries, AShareIsOneWhereTheThresholdIsReached) {
    Reduction how;
    how.kind = Reduction::Kind::share, how.threshold = 2;
    EXPECT_EQ(reduce(how, {0, 1, 2}, {0, 3, 0}), 1);
    EXPECT_EQ(reduce(how, {0, 1, 2}, {0, 1, 0}), 0);
    EXPECT_TRUE(std::isnan(reduce(how, {0, 1, 2}, {nan, nan, nan})));
    how.from = 1.5;
    EXPECT_EQ(reduce(how, {0, 1, 2}, {0, 3, 0}), 0);
    EXPECT_EQ(last_time(how, {0, 1, 2}, {0, 3, 0}), 2);
}

const std::string rise_times = R"(scene = "fifty.toml"
seeds = 5
[[vary]]
key = "drive.g_level"
values = [2, 3, 4]
[[measure]]
name = "rise"
column = "height_difference"
reduce = "first-passage"
threshold = 0.3
[[chart]]
y = "rise"
)";

// At Γ = 2 one of five came up, at 3 all, at 4 none.
struct RiseTimes {
    StudyFolderOfTest folder;
    Study study = folder.read(rise_times);
    std::vector<Member> members = make_members(study, [](const FilmedScene&, const Plan&) {});
    std::vector<MemberResult> results;

    RiseTimes() {
        for (std::size_t m = 0; m < members.size(); ++m) {
            MemberResult result;
            result.status = MemberResult::Status::complete;
            const bool came_up = m == 0 || members[m].setting == 1;
            result.values = {came_up ? 1 + 0.1 * static_cast<double>(m) : nan};
            result.until = {came_up ? nan : 3};
            results.push_back(result);
        }
    }
};

TEST(SeedSummaries, AreToldInTablesChartAndPage) {
    RiseTimes made;
    const auto series = chart_series(made.study, made.members, made.results, made.study.charts[0]);
    const std::string table = chart_table(series);
    EXPECT_THAT(table, HasSubstr("\n0,2,NaN,NaN,NaN,1,5,,2.6,1\n"));
    EXPECT_THAT(table, HasSubstr("\n0,4,NaN,NaN,NaN,0,5,,3,1\n"));
    const std::string commands = chart_commands(made.study, made.study.charts[0], series, false);
    EXPECT_THAT(commands, tells({"%d of %d", "with labels"}));
    EXPECT_THAT(commands, HasSubstr("not in all seeds"));
    EXPECT_THAT(commands, HasSubstr("set offsets graph 0.1, graph 0.1")) << "room for the counts";
    EXPECT_THAT(setting_table(made.study, made.members, made.results),
                testing::StartsWith("drive.g_level,members,complete,rise,rise_low,rise_high,rise_came_up,"
                                    "rise_at_least\n2,5,5,,,,1,2.6\n3,5,5,1.7,"));
    const std::string rows = study_table(made.study, made.members, made.results);
    EXPECT_THAT(rows, testing::StartsWith("drive.g_level,run.seed,state,rise,rise_came_up,warnings,"));
    EXPECT_THAT(rows, HasSubstr("\n2,1,complete,1,1,0,"));
    EXPECT_THAT(rows, HasSubstr("\n2,2,complete,,0,0,"));
    const std::string page = study_page(made.study, made.members, made.results, {made.folder.path()},
                                        {chart_stem(made.study.charts[0])});
    EXPECT_THAT(page, tells({"≥ 2.6", "came up", "1 of 5"}));
    EXPECT_THAT(page, HasSubstr("Open symbols"));
    EXPECT_THAT(page, Not(HasSubstr("1 of 5</td>"))) << "all five are complete";
    EXPECT_THAT(unit_table(made.study), HasSubstr("\nrise,s,"));
}

TEST(SeedSummaries, AStudyInWhichNothingCameUpSaysSo) {
    RiseTimes made;
    for (MemberResult& result : made.results) result.values = {nan}, result.until = {nan};
    const DrawnCharts charts =
        draw_charts(made.study, made.members, made.results, {{}}, made.folder.path() / "charts");
    EXPECT_TRUE(charts.drawn);
    EXPECT_TRUE(charts.stems.empty());
    EXPECT_THAT(study_page(made.study, made.members, made.results, {made.folder.path()}, {}),
                HasSubstr("in no member"));
}

// The chart is drawn by gnuplot without a word.
TEST(SeedSummaries, OpenPointsAreDrawnInSilence) {
    RiseTimes made;
    testing::internal::CaptureStderr();
    const DrawnCharts charts =
        draw_charts(made.study, made.members, made.results, {{}}, made.folder.path() / "charts");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_EQ(charts.stems.size(), 1u);
    const std::string svg = text_of(made.folder.path() / "charts" / (charts.stems[0] + ".svg"));
    for (const char* words : {"1 of 5", "0 of 5", "not in all"}) EXPECT_THAT(svg, HasSubstr(words));
}

std::string charted(const std::string& lines) {
    return rise_times + lines;
}

TEST(StudyChartKeys, SayLabelsRangesAndLetters) {
    const StudyFolderOfTest folder;
    const Study study =
        folder.read(charted("x_label = \"shaking\"\ny_label = \"time up\"\nx_per = 2\n"
                            "x_range = [0.5, 3]\ny_range = [\"0 s\", 4]\nletters = 10\n"
                            "font = \"Liberation Sans\"\n"));
    const auto members = make_members(study, [](const FilmedScene&, const Plan&) {});
    std::vector<MemberResult> results(members.size());
    for (MemberResult& result : results) result.status = MemberResult::Status::complete, result.values = {1};
    const StudyChart& chart = study.charts[0];
    const auto series = chart_series(study, members, results, chart);
    EXPECT_EQ(series[0].points[1].x, 1.5);
    const std::string commands = chart_commands(study, chart, series, false);
    for (const char* words : {"set xlabel 'shaking'", "set ylabel 'time up (s)'", "set xrange [0.5:3]",
                              "set yrange [0:4]", "'Liberation Sans,17.5'"})
        EXPECT_THAT(commands, HasSubstr(words));
}

// A share goes from 0 to 1, and its label says of what.
TEST(StudyChartKeys, AShareHasItsOwnLabelAndRange) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(with_line(rise_times, "first-passage", "share"));
    EXPECT_THAT(study.measures[0].label, testing::StartsWith("share of runs that reach 0.3: "));
    const auto members = make_members(study, [](const FilmedScene&, const Plan&) {});
    std::vector<MemberResult> results(members.size());
    for (MemberResult& result : results) result.status = MemberResult::Status::complete, result.values = {1};
    const auto series = chart_series(study, members, results, study.charts[0]);
    EXPECT_THAT(chart_commands(study, study.charts[0], series, false), HasSubstr("set yrange [0:1]"));
    EXPECT_THAT(folder.read(rise_times).measures[0].label, testing::StartsWith("time of first reaching 0.3"));
}

TEST(StudyChartKeys, AreRefusedByNameWhenWrong) {
    const StudyFolderOfTest folder;
    const auto refusal = [&](const std::string& lines) -> std::string {
        try {
            const Study study = folder.read(charted(lines));
            check_series(study, make_members(study, [](const FilmedScene&, const Plan&) {}));
        } catch (const UserError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal("x_range = [3, 2]\n"), tells({":13:", "x_range", "smaller one first"}));
    EXPECT_THAT(refusal("y_range = [\"0 mm\", 4]\n"), tells({"y_range", "in s"}));
    EXPECT_THAT(refusal("logarithmic = \"y\"\ny_range = [0, 4]\n"), tells({"y_range", "larger than 0"}));
    EXPECT_THAT(refusal("x_per = 0\n"), tells({"x_per", "larger than 0"}));
    EXPECT_THAT(refusal("font = \"x' y\"\n"), tells({"font", "letters"}));
    EXPECT_THAT(refusal("series = [\"d = 3\"]\n"), tells({":13:", "d = 3", "without a name"}));
    EXPECT_THAT(refusal("letters = 100\n"), tells({"letters", "24"}));
}

}  // namespace
}  // namespace grainreel
