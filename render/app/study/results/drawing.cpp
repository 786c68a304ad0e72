#include "render/app/study/results/drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/lab/chart/gnuplot.hpp"
#include "render/app/study/results/points.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {
namespace {

// Colours of Okabe and Ito (2008), which colour-blind people can tell apart.
constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#000000"};
// gnuplot's numbers of point types: filled, and the same shapes open.
constexpr std::array<int, 7> marks{7, 5, 9, 11, 13, 15, 3}, open_marks{6, 4, 8, 10, 12, 14, 3};

// Settings that depend on a drawing's size.
struct Look {
    PaperLines lines;
    double pen;  // width of curves
};
// Two names of the key stand side by side. With their marks and gaps, which take 14 letters each, they fill
// the width of 80 letters.
const Look screen{{80, 55, 26, 2}, 2};
constexpr double usual_letters = 8;  // points

// The chart's letters on a paper.
Paper with_letters(Paper paper, const StudyChart& chart) {
    paper.font = chart.font, paper.letters = chart.letters;
    return paper;
}

Look look_on(const Paper& paper) {
    return {lines_on(paper), 1};
}

// The look on the screen: larger letters leave room for fewer of them.
Look screen_look(const StudyChart& chart) {
    Look look = screen;
    for (std::size_t* letters : {&look.lines.across, &look.lines.upright, &look.lines.key})
        *letters = std::max<std::size_t>(
            8, static_cast<std::size_t>(static_cast<double>(*letters) * usual_letters / chart.letters));
    return look;
}

// Number of lines of the longest name in the key (the list of a chart's series). gnuplot lets names overlap
// unless they are set that far apart.
std::ptrdiff_t lines_of_key(const std::vector<ChartSeries>& series, const std::string& reference,
                            std::size_t letters) {
    const auto lines = [&](const std::string& name) { return std::ssize(wrapped(name, letters)); };
    std::ptrdiff_t most = lines(reference);
    for (const ChartSeries& each : series) most = std::max(most, lines(each.name));
    return most;
}

std::string gnuplot_number(double value) {
    return std::isnan(value) ? "NaN" : fmt::format("{}", value);
}

// Replaces line breaks: gnuplot ends a row at each of them, even between quotes.
std::string on_one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, ' ');
    return text;
}

// Commands for words in place of numbers along x. across: number of letters that have room there.
std::string word_ticks(const Variation& axis, std::size_t across) {
    const std::size_t letters = std::max<std::size_t>(8, across / axis.values.size());
    std::string ticks;
    for (std::size_t i = 0; i < axis.values.size(); ++i)
        ticks += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_lines(axis.values[i].words, letters), i);
    return fmt::format("set xtics ({})\nset xrange [-0.5:{}.5]\n", ticks, axis.values.size() - 1);
}

std::string reference_table(const std::vector<ReferencePoint>& points) {
    std::string text = "x,y,error\n";
    for (const ReferencePoint& point : points)
        text += fmt::format("{},{},{}\n", point.x, point.y, point.error);
    return text;
}

// Several series stand a little aside of each other, so that their intervals do not lie on each other.
struct Aside {
    std::size_t series = 1;
    bool logarithmic = false;
    double step = 0;  // from one series to the next, in units of the axis; a factor on a logarithmic axis
    // The place of a series' points along x, as gnuplot computes it from a column.
    std::string of(const std::string& column, std::size_t number) const {
        const double steps = static_cast<double>(number) - 0.5 * static_cast<double>(series - 1);
        if (series < 2 || steps == 0) return column;
        return logarithmic ? fmt::format("{}*{:.9g}", column, std::pow(step, steps))
                           : fmt::format("({}{:+.9g})", column, step * steps);
    }
};

Aside aside_of(const StudyChart& chart, const std::vector<ChartSeries>& series) {
    constexpr double share = 0.012, widest = 0.06;  // of the axis: one step; all series together
    std::optional<std::array<double, 2>> span;
    for (const ChartSeries& each : series)
        for (const ChartPoint& point : each.points) {
            if (!span) span = {point.x, point.x};
            span = {std::min((*span)[0], point.x), std::max((*span)[1], point.x)};
        }
    Aside aside{series.size(), chart.log_x, 0};
    if (!span || series.size() < 2) return aside;
    const double step = std::min(share, widest / static_cast<double>(series.size() - 1));
    aside.step = chart.log_x ? std::pow((*span)[1] / (*span)[0], step) : step * ((*span)[1] - (*span)[0]);
    return aside;
}

// Plots a series: its line (none between words along x) and points, and over them the error bars of points
// that have them.
std::string plot_series(const std::string& table, const ChartSeries& series, std::size_t number,
                        const Look& look, const Aside& aside, bool joined) {
    const std::string style = fmt::format("lc rgb '{}' lw {}", colours[number % colours.size()], look.pen);
    const int mark = marks[number % marks.size()];
    const std::string title =
        series.name.empty() ? "notitle" : "title " + gnuplot_lines(series.name, look.lines.key);
    const std::string x = fmt::format("(column(1)=={} ? {} : NaN)", number, aside.of("column(2)", number));
    return fmt::format(
        "{0} using {1}:3 with {5} pt {2} ps 0.9 {3} {4}, \\\n"
        "    {0} using {1}:3:4:5 with yerrorbars pt {2} ps 0.9 {3} notitle",
        table, x, mark, style, title, joined ? "linespoints" : "points");
}

bool has_open_points(const std::vector<ChartSeries>& series) {
    return std::any_of(series.begin(), series.end(), [](const ChartSeries& each) {
        return std::any_of(each.points.begin(), each.points.end(),
                           [](const ChartPoint& point) { return !point.y.came_up_everywhere(); });
    });
}

// Plots the points that came up in some seeds only: open, and with their number. An arrow stands at a bound,
// below the true value.
std::string plot_open(const std::string& table, std::size_t number, const Look& look, const Aside& aside) {
    const std::string x = fmt::format("(column(1)=={} && column(6)<column(7) ? {} : NaN)", number,
                                      aside.of("column(2)", number));
    return fmt::format(
        "{0} using {1}:(valid(9) ? column(9) : column(3)) with points pt {2} ps 1.1 lc rgb '{3}' lw {4} "
        "notitle, "
        "\\\n    {0} using {1}:(valid(9) ? column(9) : column(3)):(sprintf('%s%d of %d', column(10)==1 ? "
        "'\u2191 ' : '', column(6), column(7))) with labels offset 0,0.9 textcolor rgb '{3}' notitle",
        table, x, open_marks[number % open_marks.size()], colours[number % colours.size()], look.pen);
}

// Plots the single seeds of a series as small open points.
std::string plot_seeds(const std::string& table, std::size_t number, const Look& look, const Aside& aside) {
    return fmt::format(
        "{} using (column(1)=={} ? {} : NaN):3 with points pt 6 ps 0.5 lc rgb '{}' lw {} notitle", table,
        number, aside.of("column(2)", number), colours[number % colours.size()], 0.5 * look.pen);
}

std::string plots_of(const Study& study, const StudyChart& chart, const std::vector<ChartSeries>& series,
                     bool has_reference, const Look& look) {
    const bool joined = study.variations[chart.x].numeric;
    const std::string stem = chart_stem(chart), table = gnuplot_text(stem + ".csv");
    const Aside aside = aside_of(chart, series);
    std::string plots;
    for (std::size_t s = 0; s < series.size(); ++s)
        plots += (s > 0 ? ", \\\n    " : "") + plot_series(table, series[s], s, look, aside, joined);
    for (std::size_t s = 0; s < series.size() && has_open_points(series); ++s)
        plots += ", \\\n    " + plot_open(table, s, look, aside);
    if (has_open_points(series))
        plots += fmt::format(", \\\n    NaN with points pt 6 ps 1.1 lc rgb 'black' title {}",
                             gnuplot_lines("not in all seeds (\u2191 more)", look.lines.key));
    for (std::size_t s = 0; s < series.size() && has_seeds(series); ++s)
        plots += ", \\\n    " + plot_seeds(gnuplot_text(stem + ".seeds.csv"), s, look, aside);
    if (has_seeds(series))
        plots +=
            fmt::format(", \\\n    NaN with points pt 6 ps 0.5 lc rgb 'black' lw {} title 'single seeds'",
                        0.5 * look.pen);
    if (has_reference)
        plots += fmt::format(
            ", \\\n    {0} using 1:2:3 with yerrorbars pt 6 ps 1.1 lw 1.5 lc rgb 'black' title {1}",
            gnuplot_text(stem + ".reference.csv"), gnuplot_lines(chart.reference_label, look.lines.key));
    return plots;
}

std::string axes_and_key(const Study& study, const StudyChart& chart, const std::vector<ChartSeries>& series,
                         bool has_reference, const Look& look) {
    const Variation& axis = study.variations[chart.x];
    std::string text = fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                                   gnuplot_lines(x_title(study, chart), look.lines.across),
                                   gnuplot_lines(y_title(study, chart), look.lines.upright));
    if (!chart.title.empty())
        text += fmt::format("set title {} noenhanced\n", gnuplot_lines(chart.title, look.lines.across));
    text += fmt::format("set key noenhanced outside above left Left reverse maxcols {} spacing {:.1f}\n",
                        look.lines.keys_a_line,
                        1.1 * static_cast<double>(lines_of_key(
                                  series, has_reference ? chart.reference_label : "", look.lines.key)));
    // Counts stand above open points, and reach to both sides of them.
    const bool open = has_open_points(series);
    text += fmt::format("set offsets graph {0}, graph {0}, graph {1}, graph 0.05\n", open ? 0.1 : 0.03,
                        open ? 0.12 : 0.05);
    if (!axis.numeric) text += word_ticks(axis, look.lines.across);
    text += axis_marks(study, chart, series) + search_marks(study, chart);
    if (chart.x_range) text += fmt::format("set xrange [{}:{}]\n", (*chart.x_range)[0], (*chart.x_range)[1]);
    const bool is_share = study.measures[chart.y].average == SeedAverage::share;
    if (is_share && !chart.y_range) text += "set yrange [0:1]\n";
    if (!is_share && !chart.y_range) text += range_of_one_height(study.measures[chart.y], series);
    if (chart.y_range) text += fmt::format("set yrange [{}:{}]\n", (*chart.y_range)[0], (*chart.y_range)[1]);
    return text;
}

// What the file of a chart calls itself.
std::string title_of(const Study& study, const StudyChart& chart) {
    if (!chart.title.empty()) return chart.title;
    return fmt::format("{} against {}", y_title(study, chart), x_title(study, chart));
}

bool has_points(const std::vector<ChartSeries>& series) {
    return std::any_of(series.begin(), series.end(), [](const ChartSeries& s) {
        return std::any_of(s.points.begin(), s.points.end(),
                           [](const ChartPoint& p) { return p.y.is_seen(); });
    });
}

}  // namespace

std::string chart_stem(const StudyChart& chart) {
    return file_name_part(chart.name);
}

bool has_seeds(const std::vector<ChartSeries>& series) {
    return std::any_of(series.begin(), series.end(), [](const ChartSeries& each) {
        return std::any_of(each.points.begin(), each.points.end(), [](const ChartPoint& point) {
            return point.y.values.size() > 1 && point.y.values.size() <= few_values;
        });
    });
}

std::string seed_table(const std::vector<ChartSeries>& series) {
    std::string text = "series,x,value\n";
    for (std::size_t s = 0; s < series.size(); ++s)
        for (const ChartPoint& point : series[s].points)
            if (point.y.values.size() > 1 && point.y.values.size() <= few_values)
                for (const double value : point.y.values)
                    text += fmt::format("{},{},{}\n", s, point.x, gnuplot_number(value));
    return text;
}

std::string chart_table(const std::vector<ChartSeries>& series, SeedAverage average) {
    std::string text =
        fmt::format("series,x,{},low,high,values,members,name,of_some,bound\n", name_of(average));
    for (std::size_t s = 0; s < series.size(); ++s)
        for (const ChartPoint& point : series[s].points)
            text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", s, point.x, gnuplot_number(point.y.value),
                                gnuplot_number(point.y.low), gnuplot_number(point.y.high), point.y.count,
                                point.y.members, csv_cell(on_one_line(series[s].name)),
                                gnuplot_number(point.y.of_some), point.y.is_bound ? 1 : 0);
    return text;
}

std::string chart_commands(const Study& study, const StudyChart& chart,
                           const std::vector<ChartSeries>& series, bool has_reference) {
    const std::string stem = chart_stem(chart);
    std::string text = fmt::format("# Draws the table beside it: gnuplot {}.gp\n", stem);
    text += paper_style();
    const Look look = screen_look(chart);
    const double larger = chart.letters / usual_letters;
    text += axes_and_key(study, chart, series, has_reference, look);
    text += fmt::format(
        "do for [form in 'svg png'] {{\n"
        "    if (form eq 'svg') {{ set terminal svg noenhanced size 800,560 font '{0},{1:.4g}' background "
        "'white' }}\n"
        "    else {{ set terminal pngcairo noenhanced size 1200,840 font '{0},{2:.4g}' }}\n"
        "    set output {3}.'.'.form\n    plot {4}\n}}\n",
        chart.font, 14 * larger, 18 * larger, gnuplot_text(stem),
        plots_of(study, chart, series, has_reference, look));
    return text;
}

DrawnCharts draw_charts(const Study& study, const std::vector<Member>& members,
                        const std::vector<MemberResult>& results,
                        const std::vector<std::vector<ReferencePoint>>& references,
                        const std::filesystem::path& folder) {
    DrawnCharts charts;
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < study.charts.size(); ++i) {
        const StudyChart& chart = study.charts[i];
        const std::vector<ChartSeries> series = chart_series(study, members, results, chart);
        const std::string stem = chart_stem(chart);
        const SeedAverage average = study.measures[chart.y].average;
        replace_file(folder / (stem + ".csv"), chart_table(series, average));
        if (!has_points(series)) continue;
        replace_file(folder / (stem + ".caption.tex"), chart_caption(study, chart, series));
        if (has_seeds(series)) replace_file(folder / (stem + ".seeds.csv"), seed_table(series));
        if (!references[i].empty())
            replace_file(folder / (stem + ".reference.csv"), reference_table(references[i]));
        replace_file(folder / (stem + ".gp"), chart_commands(study, chart, series, !references[i].empty()));
        if (run_gnuplot(folder, stem + ".gp")) {
            charts.stems.push_back(stem);
            say_title(folder / (stem + ".svg"), title_of(study, chart));
        } else {
            charts.drawn = false;
        }
    }
    return charts;
}

std::vector<std::filesystem::path> print_charts(const Study& study, const std::vector<Member>& members,
                                                const std::vector<MemberResult>& results,
                                                const std::vector<std::vector<ReferencePoint>>& references,
                                                const Paper& paper, const std::filesystem::path& folder) {
    std::error_code failure;
    if (!std::filesystem::create_directories(folder, failure) && failure)
        throw UserError("--charts {}: cannot be made ({})", folder.string(), failure.message());
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 0; i < study.charts.size(); ++i) {
        const StudyChart& chart = study.charts[i];
        const std::vector<ChartSeries> series = chart_series(study, members, results, chart);
        if (!has_points(series)) continue;
        const std::string stem = chart_stem(chart);
        const bool has_reference = !references[i].empty();
        const Paper own = with_letters(paper, chart);
        const Look look = look_on(own);
        replace_file(folder / (stem + ".csv"), chart_table(series, study.measures[chart.y].average));
        replace_file(folder / (stem + ".caption.tex"), chart_caption(study, chart, series));
        if (has_seeds(series)) replace_file(folder / (stem + ".seeds.csv"), seed_table(series));
        if (has_reference) replace_file(folder / (stem + ".reference.csv"), reference_table(references[i]));
        for (auto& file : draw_on_paper(
                 folder, stem, paper_style() + axes_and_key(study, chart, series, has_reference, look),
                 plots_of(study, chart, series, has_reference, look), own)) {
            if (file.extension() == ".svg") say_title(file, title_of(study, chart));
            files.push_back(std::move(file));
        }
    }
    return files;
}

}  // namespace grainreel
