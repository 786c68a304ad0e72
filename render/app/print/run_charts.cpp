#include "render/app/print/run_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/lab/chart/gnuplot.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/text/units.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "render/page/facts/run_names.hpp"
#include "render/page/page_measures.hpp"
#include "render/picture/plots/axes.hpp"
#include "render/scene/axis_titles.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// Colours of Okabe and Ito (2008), as in the charts of studies. The kinds of dashes are in the order of the
// page of several runs (render/page/html/charts.js).
constexpr std::array<const char*, 6> colours{"#0072b2", "#d55e00", "#009e73",
                                             "#cc79a7", "#e69f00", "#000000"};
constexpr std::array<const char*, 6> dashes{"solid", "(8,3)", "(2,2)", "(8,2,2,2)", "(4,2)", "(1,3)"};

struct MeasuredRun {
    fs::path folder;
    FilmedScene scene;
    std::shared_ptr<const MeasureTable> table;
    std::string name;

    // The index of a column; none when the table lacks it.
    std::optional<std::size_t> column(const std::string& title) const {
        return place_in(table->columns(), title);
    }
    std::vector<double> values(const std::string& title) const {
        const auto place = column(title);
        return place ? table->values(*place, 0, table->rows()) : std::vector<double>();
    }
};

std::deque<MeasuredRun> measured_runs(const std::vector<fs::path>& folders,
                                      const std::vector<std::string>& given) {
    std::deque<MeasuredRun> runs;
    std::vector<RunToName> to_name;
    for (const fs::path& folder : folders) {
        MeasuredRun& run = runs.emplace_back();
        run.folder = folder_of_run(folder);
        run.scene = scene_of_run(run.folder, {});
        const fs::path file = run.folder / "measures.csv";
        run.table = read_measures_file(file).table;
        if (!run.table || run.table->rows() == 0)
            throw UserError("{}: is missing or empty, so there is nothing to chart", file.string());
        if (!run.column("time_s")) throw UserError("{}:1: lacks the column time_s", file.string());
        const std::size_t k = to_name.size();
        to_name.push_back({run.folder, run.scene, k < given.size() ? given[k] : ""});
    }
    const std::vector<std::string> names = names_of_runs(to_name);
    for (std::size_t k = 0; k < runs.size(); ++k) runs[k].name = names[k];
    return runs;
}

bool has_values(const std::deque<MeasuredRun>& runs, const std::string& measure) {
    return std::any_of(runs.begin(), runs.end(), [&](const MeasuredRun& run) {
        const std::vector<double> values = run.values(measure);
        return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
    });
}

void add_once(std::vector<std::string>& names, const std::string& name) {
    if (!contains(names, name)) names.push_back(name);
}

// Names of the measures to draw: the wanted ones; for "all", all that have values; if none is wanted, those
// that the runs' pages show at first.
std::vector<std::string> chosen(const std::deque<MeasuredRun>& runs, const std::vector<std::string>& wanted) {
    std::vector<std::string> names;
    const bool all = wanted == std::vector<std::string>{"all"};
    for (const MeasuredRun& run : runs) {
        const std::vector<std::string>& columns = run.table->columns();
        if (all)
            for (const std::string& name : columns)
                if (name != "time_s" && name != "step" && has_values(runs, name)) add_once(names, name);
        if (wanted.empty())
            for (const std::size_t column : page_measures(run.scene, *run.table).charted)
                add_once(names, columns[column]);
    }
    if (!all)
        for (const std::string& name : wanted) {
            const bool known = std::any_of(runs.begin(), runs.end(),
                                           [&](const MeasuredRun& run) { return run.column(name); });
            if (!known)
                throw UserError("--measures {}: no such column; {} has {}", excerpt(name),
                                (runs.front().folder / "measures.csv").string(),
                                fmt::join(runs.front().table->columns(), ", "));
            add_once(names, name);
        }
    if (names.empty())
        throw UserError(
            "{}: no measure changes, so the page has no charts; name some with "
            "--measures, or all",
            runs.front().folder.string());
    return names;
}

struct MeasureAxis {
    std::string title;                 // with the unit
    double size = 1;                   // SI units in one unit of the axis
    std::array<double, 2> span{0, 1};  // range of all values, SI
};

// The span of all values. It begins at 0 or below for a measure whose axis starts at zero.
std::array<double, 2> span_of(const std::deque<MeasuredRun>& runs, const std::string& measure) {
    std::optional<std::array<double, 2>> span;
    for (const MeasuredRun& run : runs)
        for (const double value : run.values(measure)) {
            if (!std::isfinite(value)) continue;
            if (!span) span = {value, value};
            span = {std::min((*span)[0], value), std::max((*span)[1], value)};
        }
    std::array<double, 2> range = span.value_or(std::array<double, 2>{0, 1});
    for (const MeasuredRun& run : runs)
        if (axis_of_column(run.scene, measure).from_zero) range[0] = std::min(0.0, range[0]);
    return range;
}

// The axis of a measure, in a unit that suits the largest value.
MeasureAxis axis_of(const std::deque<MeasuredRun>& runs, const std::string& measure) {
    const std::array<double, 2> span = span_of(runs, measure);
    const double largest = std::max(std::abs(span[0]), std::abs(span[1]));
    for (const MeasuredRun& run : runs)
        for (const MeasureColumn& column : measure_columns(run.scene))
            if (column.name == measure) {
                const std::string unit = fitting_unit(largest, column.dimension);
                const std::string known = unit == "1" ? "" : unit;
                return {with_unit(column.label, known), unit_size(known, column.dimension), span};
            }
    return {measure, 1, span};
}

// Commands that give the upright axis round limits with a tick at each.
std::string upright_axis(const MeasureAxis& axis) {
    constexpr int most_ticks = 7;
    const auto [low, high] = round_limits(axis.span[0] / axis.size, axis.span[1] / axis.size, most_ticks);
    const std::vector<double> ticks = round_ticks(low, high, most_ticks);
    std::string text = fmt::format("set yrange [{:.9g}:{:.9g}]\n", low, high);
    if (ticks.size() > 1) text += fmt::format("set ytics {:.9g}\n", ticks[1] - ticks[0]);
    return text;
}

MeasureAxis time_axis(const std::deque<MeasuredRun>& runs) {
    constexpr double short_run = 0.1;  // s; shorter runs are shown in ms, as in films
    double end = 0;
    for (const MeasuredRun& run : runs)
        for (const double time : run.values("time_s"))
            if (std::isfinite(time)) end = std::max(end, time);
    if (end < short_run) return {"time (ms)", 1e-3, {0, end}};
    return {"time (s)", 1, {0, end}};
}

class RunCharts {
  public:
    RunCharts(const std::deque<MeasuredRun>& runs, const Paper& paper, const fs::path& folder)
        : runs_(runs), paper_(paper), folder_(folder), time_(time_axis(runs)) {}

    std::vector<fs::path> draw(const std::string& measure) const {
        const std::string stem = file_name_part(measure);
        const MeasureAxis axis = axis_of(runs_, measure);
        std::string table = fmt::format("run,time_s,{}{}\n", measure, runs_.size() > 1 ? ",name" : ""), plots;
        for (std::size_t k = 0; k < runs_.size(); ++k) {
            table += curve_table(k, runs_[k].values("time_s"), runs_[k].values(measure),
                                 runs_.size() > 1 ? runs_[k].name : "");
            plots += (k > 0 ? ", \\\n    " : "") + plot(k, stem, axis.size);
        }
        replace_file(folder_ / (stem + ".csv"), table);
        return draw_on_paper(folder_, stem, commands(axis), plots, paper_);
    }

  private:
    std::string commands(const MeasureAxis& axis) const {
        const PaperLines lines = lines_on(paper_);
        std::string text = paper_style();
        text +=
            fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                        gnuplot_lines(time_.title, lines.across), gnuplot_lines(axis.title, lines.upright));
        text += "set autoscale xfix\n" + upright_axis(axis);
        if (runs_.size() == 1) return text + "unset key\n";
        std::ptrdiff_t most = 1;
        for (const MeasuredRun& run : runs_) most = std::max(most, std::ssize(wrapped(run.name, lines.key)));
        return text +
               fmt::format("set key noenhanced outside above left Left reverse maxcols {} spacing {:.1f}\n",
                           lines.keys_a_line, 1.1 * static_cast<double>(most));
    }

    std::string plot(std::size_t k, const std::string& stem, double size) const {
        const std::string title = runs_.size() == 1
                                      ? std::string("notitle")
                                      : "title " + gnuplot_lines(runs_[k].name, lines_on(paper_).key);
        return fmt::format(
            "{} using (column(1)=={} ? column(2)/{} : NaN):(column(3)/{}) with lines lw 1 lc rgb '{}' "
            "dt {} {}",
            gnuplot_text(stem + ".csv"), k, time_.size, size, colours[k % colours.size()],
            dashes[k % dashes.size()], title);
    }

    const std::deque<MeasuredRun>& runs_;
    const Paper& paper_;
    const fs::path& folder_;
    const MeasureAxis time_;
};

}  // namespace

std::vector<fs::path> draw_run_charts(const std::vector<fs::path>& folders,
                                      const std::vector<std::string>& given,
                                      const std::vector<std::string>& measures, const Paper& paper,
                                      const fs::path& folder) {
    const std::deque<MeasuredRun> runs = measured_runs(folders, given);
    const std::vector<std::string> names = chosen(runs, measures);
    std::error_code failure;
    if (!fs::create_directories(folder, failure) && failure)
        throw UserError("--charts {}: cannot be made ({})", folder.string(), failure.message());
    const RunCharts charts(runs, paper, folder);
    std::vector<fs::path> files;
    for (const std::string& name : names)
        for (const fs::path& file : charts.draw(name)) files.push_back(file);
    return files;
}

namespace {

std::string cell(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return quoted + "\"";
}

// The rows of a curve that are drawn.
std::vector<std::size_t> shown_rows(const std::vector<double>& y) {
    std::vector<std::size_t> rows;
    const std::size_t parts = kMostCurvePoints / 4, count = y.size();
    if (count <= kMostCurvePoints) {
        for (std::size_t i = 0; i < count; ++i) rows.push_back(i);
        return rows;
    }
    const auto less = [&](std::size_t a, std::size_t b) { return y[a] < y[b]; };
    for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t from = part * count / parts, to = (part + 1) * count / parts;
        std::vector<std::size_t> some, kept{from, to - 1};
        for (std::size_t i = from; i < to; ++i) std::isfinite(y[i]) ? some.push_back(i) : kept.push_back(i);
        if (!some.empty()) {
            const auto [low, high] = std::minmax_element(some.begin(), some.end(), less);
            kept.insert(kept.end(), {*low, *high});
        }
        std::sort(kept.begin(), kept.end());
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        rows.insert(rows.end(), kept.begin(), kept.end());
    }
    return rows;
}

}  // namespace

std::string curve_table(std::size_t number, const std::vector<double>& x, const std::vector<double>& y,
                        const std::string& name) {
    std::string text;
    const std::string last = name.empty() ? "" : "," + cell(name);
    bool gap = true;  // the last line is empty; a second empty line would begin another data set
    for (const std::size_t row : shown_rows(y)) {
        const bool known = std::isfinite(x[row]) && std::isfinite(y[row]);
        if (known) text += fmt::format("{},{},{}{}\n", number, x[row], y[row], last);
        if (!known && !gap) text += "\n";
        gap = !known;
    }
    return text;
}

}  // namespace grainreel
