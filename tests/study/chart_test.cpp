// Tests of points, tables and charts of made-up results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/lab/chart/gnuplot.hpp"
#include "render/app/print/run_charts.hpp"
#include "render/app/study/file/variations.hpp"
#include "render/app/study/page.hpp"
#include "render/app/study/results/drawing.hpp"
#include "render/app/study/results/points.hpp"
#include "render/app/study/results/results.hpp"
#include "render/app/study/results/warnings.hpp"
#include "render/page/embed.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/study/study_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;
using Status = MemberResult::Status;

TEST(StudyChartLabels, HaveTheUnitUnlessTheyNameIt) {
    EXPECT_EQ(axis_title("kinetic energy, mean", "J"), "kinetic energy, mean (J)");
    EXPECT_EQ(axis_title("share of big grains", ""), "share of big grains");
    EXPECT_EQ(axis_title("flow along the wall, m a period", "m"), "flow along the wall, m a period");
    EXPECT_EQ(axis_title("rate of the drum, rad/s", "rad/s"), "rate of the drum, rad/s");
    EXPECT_EQ(axis_title("angle (degrees)", "degree"), "angle (degrees)");
    EXPECT_EQ(axis_title("time to empty", "m"), "time to empty (m)");
    EXPECT_EQ(axis_title("mass", "s"), "mass (s)");
    EXPECT_EQ(axis_title("s", "s"), "s");
}

// A label that names another unit of the same kind has the numbers in that unit.
TEST(StudyChartLabels, MayNameAnotherUnit) {
    const auto unit = [](const char* label, const char* own) { return shown_unit(label, own); };
    EXPECT_EQ(unit("kinetic energy (mJ)", "J").unit, "mJ");
    EXPECT_NEAR(unit("kinetic energy (mJ)", "J").factor, 1000, 1e-9);
    EXPECT_NEAR(unit("height in mm", "m").factor, 1000, 1e-9);
    EXPECT_NEAR(unit("time to empty, min", "s").factor, 1.0 / 60, 1e-12);
    for (const auto& [label, own] : {std::pair{"kinetic energy (J)", "J"}, std::pair{"energy (s)", "J"},
                                     std::pair{"height in bed heights", "m"}, std::pair{"angle (deg)", ""},
                                     std::pair{"energy (mJ) of the big", "J"}})
        EXPECT_EQ(unit(label, own).factor, 1) << label;
    EXPECT_EQ(axis_title("energy (mJ)", unit("energy (mJ)", "J").unit), "energy (mJ)");
}

struct Made {
    StudyFolderOfTest folder;
    Study study;
    std::vector<Member> members;
    std::vector<MemberResult> results;

    explicit Made(const std::string& text) : study(folder.read(text)) {
        members = make_members(study, [](const FilmedScene&, const Plan&) {});
        for (std::size_t m = 0; m < members.size(); ++m) {
            MemberResult result;
            result.status = Status::complete;
            result.values = {0, static_cast<double>(m)};
            results.push_back(result);
        }
    }
};

// Two seeds of a setting have the values m and m + 1: the mean is m + 1/2, s = 1/sqrt 2, and half the
// interval is t_1 s / sqrt 2.
TEST(StudyChartPoints, AreMeansOverSeedsAlone) {
    Made made(small_study);
    const std::vector<ChartSeries> series =
        chart_series(made.study, made.members, made.results, made.study.charts[0]);
    ASSERT_EQ(series.size(), 3u);
    EXPECT_EQ(series[1].name, "d of big = 5.5 mm");
    ASSERT_EQ(series[1].points.size(), 2u);
    EXPECT_EQ(series[1].points[0].x, 2);
    EXPECT_EQ(series[1].points[1].x, 3);
    EXPECT_EQ(series[1].points[0].y.value, 2.5);
    EXPECT_EQ(series[1].points[1].y.value, 8.5);
    EXPECT_NEAR(series[1].points[0].y.high, 2.5 + student_t(0.95, 1) / 2, 1e-12);
}

TEST(StudyChartPoints, LeaveOutWhatIsNotThere) {
    Made made(small_study);
    made.results[0].status = Status::failed;
    made.results[0].values.clear();
    made.results[2].values[1] = std::numeric_limits<double>::quiet_NaN();
    const std::vector<ChartSeries> series =
        chart_series(made.study, made.members, made.results, made.study.charts[0]);
    EXPECT_EQ(series[0].points[0].y.members, 1u);
    EXPECT_EQ(series[0].points[0].y.value, 1);
    EXPECT_EQ(series[1].points[0].y.members, 2u);
    EXPECT_EQ(series[1].points[0].y.count, 1u);
    EXPECT_TRUE(std::isnan(series[1].points[0].y.value)) << "one of two seeds has a value";
    EXPECT_EQ(series[1].points[0].y.of_some, 3);
    EXPECT_EQ(setting_summary(made.study, made.members, made.results, 1, 1).count, 1u);
}

TEST(StudyChartLabels, StandOnTheChartWithTheirUnits) {
    Made made(small_study);
    StudyChart chart = made.study.charts[0];
    chart.x = 1, chart.y = 0;
    const std::string commands =
        chart_commands(made.study, chart, chart_series(made.study, made.members, made.results, chart), false);
    EXPECT_THAT(commands, tells({"set xlabel 'd of big", "(mm)'"}));
    EXPECT_THAT(commands, tells({"set ylabel 'kinetic energy", "(J)'"}));
    // Two names of 29 letters side by side were cut off at the chart's edge.
    const StudyChart& sizes = made.study.charts[0];
    made.study.variations[1].shown = "species.big.diameter";
    EXPECT_THAT(
        chart_commands(made.study, sizes, chart_series(made.study, made.members, made.results, sizes), false),
        HasSubstr("title 'species.big.diameter = 5.5'.\"\\n\".'mm'"));
    EXPECT_THAT(study_page(made.study, made.members, made.results, {made.folder.path()}, {}),
                HasSubstr("<th>kinetic energy, mean (J)</th>"));
}

TEST(StudyChartLabels, NameKeysAsFilmsDo) {
    EXPECT_EQ(name_in_films("drive.g_level"), "Γ");
    EXPECT_EQ(name_in_films("drive.frequency"), "f");
    EXPECT_EQ(name_in_films("species.nut.diameter"), "d of nut");
    EXPECT_EQ(name_in_films("species.nut.density"), "density of nut");
    EXPECT_EQ(name_in_films("contact.friction"), "friction");
    EXPECT_EQ(name_in_films("contact.wall.friction"), "wall friction");
    EXPECT_EQ(name_in_films("container.outlet.width"), "outlet width");
    EXPECT_EQ(name_in_films("container.width"), "width");
    EXPECT_EQ(name_in_films("start.packing_seed"), "packing seed");
}

// Series stand aside of each other, and the seeds of each point are drawn while there are few of them.
TEST(StudyChartPoints, OfSeveralSeriesDoNotLieOnEachOther) {
    Made made(small_study);
    const StudyChart& chart = made.study.charts[0];
    const std::vector<ChartSeries> series = chart_series(made.study, made.members, made.results, chart);
    ASSERT_EQ(series.size(), 3u);
    const std::string commands = chart_commands(made.study, chart, series, false);
    // Γ goes from 2 to 3: one step aside is 0.012 of that.
    EXPECT_THAT(commands, HasSubstr("(column(1)==0 ? (column(2)-0.012) : NaN):3:4:5"));
    EXPECT_THAT(commands, HasSubstr("(column(1)==1 ? column(2) : NaN):3:4:5"));
    EXPECT_THAT(commands, HasSubstr("(column(1)==2 ? (column(2)+0.012) : NaN):3:4:5"));
    EXPECT_THAT(commands, HasSubstr("set border 3"));
    ASSERT_TRUE(has_seeds(series));
    EXPECT_THAT(commands, HasSubstr(".seeds.csv"));
    const std::string table = seed_table(series);
    EXPECT_THAT(table, testing::StartsWith("series,x,value\n0,2,"));
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 3 * 2 * 2) << "series, Γ, seeds";
    std::vector<ChartSeries> many = series;
    for (ChartSeries& each : many)
        for (ChartPoint& point : each.points) point.y.values.assign(few_values + 1, 1.0);
    EXPECT_FALSE(has_seeds(many));
}

// The half of the interval has two digits, and the mean as many decimals.
TEST(StudyIntervals, DigitsFollowTheInterval) {
    EXPECT_EQ(interval_text({5, 0.41234, 0.03123}), "0.412 ± 0.031");
    EXPECT_EQ(interval_text({5, -0.0687, 0.183}), "−0.07 ± 0.18");
    EXPECT_EQ(interval_text({5, 1234.5, 312}), "1230 ± 310");
    EXPECT_EQ(interval_text({5, -0.001, 0.5}), "0.00 ± 0.50");
    EXPECT_EQ(interval_text({1, -0.25, 0}), "−0.25");
    EXPECT_EQ(interval_text({0, 0, 0}), "–");
}

TEST(StudyChartPoints, AreInTheUnitOfTheirLabel) {
    Made made(small_study);
    StudyChart chart = made.study.charts[0];
    chart.y = 0, chart.y_label = "energy (mJ)";
    for (MemberResult& result : made.results) result.values[0] = 0.002;
    const auto series = chart_series(made.study, made.members, made.results, chart);
    EXPECT_NEAR(series[0].points[0].y.value, 2, 1e-12);
    EXPECT_EQ(y_title(made.study, chart), "energy (mJ)");
}

// 2e-5 to 4e-4: from 2\u00b710\u207b\u2075 to 5\u00b710\u207b\u2074, and not over four decades.
TEST(StudyChartAxes, HavePowersOfTen) {
    Made made(small_study);
    StudyChart chart = made.study.charts[0];
    chart.log_y = true;
    std::vector<ChartSeries> series{{"", {{2, {}}, {3, {}}}}};
    series[0].points[0].y.value = 2e-5, series[0].points[1].y.value = 4e-4;
    const std::string marks = axis_marks(made.study, chart, series);
    EXPECT_THAT(marks, HasSubstr("set yrange [2e-05:0.0005]"));
    EXPECT_THAT(marks, HasSubstr("'10\u207b\u2074' 0.0001 0"));
    EXPECT_THAT(marks, HasSubstr("'5\u00b710\u207b\u2075' 5e-05 0"));
    chart.log_y = false;
    EXPECT_THAT(axis_marks(made.study, chart, series), HasSubstr("'4\u00b710\u207b\u2074' 0.0004"));
    EXPECT_EQ(power_text(1e-5), "10\u207b\u2075");
}

TEST(StudyChartAxes, OfPointsOfOneHeightBeginAtZero) {
    StudyMeasure time;
    time.from_zero = true;
    std::vector<ChartSeries> series{{"", {{1, {}}, {2, {}}}}};
    for (ChartPoint& point : series[0].points) point.y.of_some = 2;
    EXPECT_EQ(range_of_one_height(time, series), "set yrange [0:3]\n");
    series[0].points[0].y.of_some = 1;
    EXPECT_EQ(range_of_one_height(time, series), "");
}

TEST(StudyCaptions, SayOnlyWhatIsThere) {
    Made made(small_study);
    const StudyChart& chart = made.study.charts[0];
    const auto series = chart_series(made.study, made.members, made.results, chart);
    const std::string caption = chart_caption(made.study, chart, series);
    EXPECT_THAT(caption, tells({"$\\Gamma$", "n = 2", "95 \\%", "rings"}));
    EXPECT_THAT(caption, Not(HasSubstr("Open symbols")));
    EXPECT_THAT(chart_commands(made.study, chart, series, false), HasSubstr("title 'single seeds'"));
}

TEST(StudyWarnings, AreOneWhereNumbersDiffer) {
    Made made(small_study);
    made.results[0].warnings = {"from 0.5 s on it repeats itself every 2 periods (0.19 diameters)"};
    made.results[1].warnings = {"from 0.494 s on it repeats itself every 2 periods (0.2 diameters)"};
    made.results[3].warnings = {"other"};
    const auto all = shared_warnings(made.results);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].text,
              "from 0.494 to 0.5 s on it repeats itself every 2 periods (0.19 to 0.2 diameters)");
    EXPECT_EQ(members_text(made.study, made.members, all[0].members),
              "\u0393 = 2, d of big = 5 mm, seed 1, 2");
    EXPECT_THAT(study_page(made.study, made.members, made.results, {made.folder.path()}, {}),
                HasSubstr("5 mm, seed 1"));
}

TEST(StudyPage, SaysInWordsWhatChartsShow) {
    Made made(small_study);
    const std::string stem = chart_stem(made.study.charts[0]);
    const std::string page = study_page(made.study, made.members, made.results, {made.folder.path()}, {stem});
    EXPECT_THAT(page, tells({"against Γ", "d of big = 5 mm"}));
    EXPECT_THAT(page, HasSubstr(" at 2, "));
    EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
    EXPECT_THAT(page, HasSubstr("@media print"));
}

TEST(StudyTable, HasARowAMember) {
    Made made(small_study);
    made.results[1].status = Status::failed;
    made.results[1].values.clear();
    made.results[1].error = "it blew up, \"loudly\"";
    const std::string table = study_table(made.study, made.members, made.results);
    EXPECT_THAT(
        table, testing::StartsWith("drive.g_level,species.big.diameter [mm],run.seed,state,kinetic_mean,rise,"
                                   "warnings,error,folder\n2,5,1,complete,0,0,0,,members/"));
    EXPECT_THAT(table, HasSubstr("\n2,5,2,failed,,,0,\"it blew up, \"\"loudly\"\"\",members/"));
    EXPECT_THAT(table, HasSubstr("\n2,5.5,1,complete,0,2,0,,members/"));
}

TEST(StudyText, IsEscapedWhereverItGoes) {
    EXPECT_EQ(html_text("<a href=\"x\">'&"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
    EXPECT_EQ(gnuplot_text("`x` \\ \"\n"), "'`x` \\ \" '");
    EXPECT_EQ(gnuplot_text("it's `x`\n"), "\"it\\047s \\140x\\140 \"");  // octal numbers of ' and `
    EXPECT_EQ(gnuplot_lines("height of it's \u0393\u0393, m", 14),
              "\"height of it\\047s\".\"\\n\".'\u0393\u0393, m'");
    EXPECT_EQ(gnuplot_lines("an unbreakable word", 4),
              "'an'.\"\\n\".'unbr'.\"\\n\".'eaka'.\"\\n\".'ble'.\"\\n\".'word'");
    EXPECT_EQ(gnuplot_lines("", 4), "''");
    EXPECT_EQ(shell_word("a b'c"), "'a b'\\''c'");
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_words({"--set", "drive.frequency=\"25 Hz\""}), "--set 'drive.frequency=\"25 Hz\"'");
    EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
}

TEST(PrintedCurve, HasARowAPointAndAnEmptyLineForAGap) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(curve_table(1, {0, 1, 2, 3, 4}, {none, 5, none, none, 6}, "a \"b\""),
              "1,1,5,\"a \"\"b\"\"\"\n\n1,4,6,\"a \"\"b\"\"\"\n");
    EXPECT_EQ(curve_table(0, {0, 0.5}, {1, 2}, ""), "0,0,1\n0,0.5,2\n");
    EXPECT_EQ(curve_table(0, {0, 0.5}, {}, ""), "");
}

// Only what is visible remains of 100 times as many points: both ends, a lone peak, a lone pit, a lone gap.
TEST(PrintedCurve, KeepsWhatIsSeenOfManyPoints) {
    const std::size_t count = 100 * kMostCurvePoints;
    std::vector<double> x(count), y(count, 0.25);
    for (std::size_t i = 0; i < count; ++i) x[i] = static_cast<double>(i);
    y[12345] = 7;
    y[54321] = -3;
    y[99999] = std::numeric_limits<double>::quiet_NaN();
    y.front() = 1;
    y.back() = 2;
    const std::string table = curve_table(0, x, y, "");
    for (const char* row : {"\n0,12345,7\n", "\n0,54321,-3\n", "\n0,799999,2\n", "\n\n"})
        EXPECT_THAT(table, HasSubstr(row));
    EXPECT_THAT(table, testing::StartsWith("0,0,1\n"));
    EXPECT_LE(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), kMostCurvePoints + 2);
}

// For gnuplot 5.4 a doubled quote at the beginning of a text, or two of them in a row, would end the text.
TEST(StudyCharts, AreDrawnWhereverNamesHaveQuotes) {
    for (const std::string name : {"'", "'quoted'", "a''b", "' ' \"`ls` \\n @x $y"}) {
        Made made(small_study);
        made.study.charts[0].title = made.study.charts[0].reference_label = name;
        made.study.measures[1].label = made.study.variations[0].label = made.study.variations[1].label = name;
        const DrawnCharts charts =
            draw_charts(made.study, made.members, made.results, {{{2, 5, 1}}}, made.folder.path() / "charts");
        ASSERT_TRUE(charts.drawn) << name;
        const std::string svg = text_of(made.folder.path() / "charts" / (charts.stems[0] + ".svg"));
        EXPECT_THAT(svg, HasSubstr(">" + name + "<")) << name;
    }
}

// The names mean something to gnuplot, SVG, HTML or a shell: they appear as text, and no command is run.
TEST(StudyCharts, AreDrawnWhateverTheNames) {
    const std::string hostile = "x'; system(\"touch hit\"); `touch hit` $(touch hit) <script>&@{}_^%";
    Made made(small_study);
    made.study.title = hostile;
    made.study.charts[0].title = made.study.charts[0].name = hostile;
    made.study.charts[0].reference_label = hostile;
    made.study.measures[1].label = made.study.variations[0].label = made.study.variations[1].label = hostile;
    const DrawnCharts charts = draw_charts(made.study, made.members, made.results, {{{2, 5, 1}, {3, 6, 0}}},
                                           made.folder.path() / "charts");
    ASSERT_TRUE(charts.drawn);
    ASSERT_EQ(charts.stems.size(), 1u);
    const std::string svg = text_of(made.folder.path() / "charts" / (charts.stems[0] + ".svg"));
    EXPECT_THAT(svg, HasSubstr("touch hit"));
    EXPECT_THAT(svg, Not(HasSubstr("<script>")));
    EXPECT_TRUE(std::filesystem::exists(made.folder.path() / "charts" / (charts.stems[0] + ".png")));
    EXPECT_FALSE(std::filesystem::exists(made.folder.path() / "charts" / "hit"));
    made.results[3].status = Status::failed;
    made.results[3].error = hostile;
    const std::string page =
        study_page(made.study, made.members, made.results, {made.folder.path()}, charts.stems);
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
    EXPECT_THAT(page, Not(HasSubstr("<script>")));
}

TEST(StudyReference, IsReadRowByRow) {
    const StudyFolderOfTest folder;
    const auto read = [&](const std::string& text) { return read_reference(text, folder / "points.csv"); };
    const std::vector<ReferencePoint> from_spreadsheet = read(
        "\xef\xbb\xbf"
        "1,2\r\n3,4\r\n");
    ASSERT_EQ(from_spreadsheet.size(), 2u);
    EXPECT_EQ(from_spreadsheet[0].x, 1);
    const std::vector<ReferencePoint> points = read("# Knight 1993\r\nx,y,error\r\n1,2,0.5\r\n 3 , 4\r\n");
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].error, 0.5);
    EXPECT_EQ(points[1].x, 3);
    EXPECT_EQ(points[1].y, 4);
    EXPECT_EQ(points[1].error, 0);
    for (const auto& [text, place] :
         {std::pair{"1,2\n3,x\n", ":2:3: \"x\" is no number"},
          std::pair{"1,2\n3\n", ":2:1: there are 1 numbers"},
          std::pair{"1,2\n3,4,-1\n", ":2:5: the error of y is negative"}, std::pair{"1,2\n3,nan\n", ":2:3: "},
          std::pair{"x,y\n", ": has no points"}}) {
        try {
            read(text);
            ADD_FAILURE() << text;
        } catch (const UserError& error) {
            EXPECT_THAT(error.what(), HasSubstr((folder / "points.csv").string() + place));
        }
    }
}

}  // namespace
}  // namespace grainreel
