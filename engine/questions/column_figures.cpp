#include "engine/questions/column_figures.hpp"

#include <fmt/format.h>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/typed_time.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/questions/steadiness.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {
namespace {

AnswerCell known(double value) {
    return std::isfinite(value) ? AnswerCell(value) : AnswerCell();
}

AnswerCell counted_cell(std::size_t count) {
    return static_cast<std::int64_t>(count);
}

// The rows of one column in the window.
struct Rows {
    std::vector<double> times, values;
};

Rows rows_in(const MeasureTable& table, const std::string& column, const TimeWindow& window) {
    const std::vector<double> times = table.all("time_s"), values = table.all(column);
    Rows rows;
    for (const std::size_t i : typed_span(times, 0, window.from, window.to)) {
        rows.times.push_back(times[i]);
        rows.values.push_back(values[i]);
    }
    if (rows.times.empty())
        throw UserError(
            "no row of measures.csv lies from {:.6g} s to {:.6g} s; the run has {:.6g} s to "
            "{:.6g} s",
            window.from, window.to, times.empty() ? 0 : times.front(), times.empty() ? 0 : times.back());
    return rows;
}

std::string unit_per_second(Dimension dimension) {
    const std::string unit = text_of(dimension).unit;
    return unit == "1" ? "1/s" : unit + "/s";
}

AnswerTable means_table() {
    return {"mean",
            "Means",
            {{"column", Dimension::number, ""},
             {"rows", Dimension::number, ""},
             {"mean", Dimension::number, "all rows have the same weight"},
             {"half_width", Dimension::number, "of the mean's interval of 95 %"},
             {"deviation", Dimension::number, "of the rows"},
             {"least", Dimension::number, ""},
             {"most", Dimension::number, ""},
             {"last", Dimension::number, ""}},
            {}};
}

AnswerTable slopes_table() {
    return {"slope",
            "Slopes of the lines of least squares",
            {{"column", Dimension::number, ""},
             {"rows", Dimension::number, ""},
             {"slope", Dimension::number, ""},
             {"half_width", Dimension::number, "of its interval of 95 %"},
             {"unit", Dimension::number, ""},
             {"from", Dimension::time, "first row"},
             {"to", Dimension::time, "last row"}},
            {}};
}

void add_note(Answer& answer, const std::string& column, const Estimate& estimate, const char* what) {
    if (!estimate.why.empty())
        answer.notes.push_back(fmt::format("{}: no interval of the {}, {}", column, what, estimate.why));
}

Answer in_one(const StoredRun& run, const ColumnsRequest& request) {
    const Scene& scene = run.known_scene();
    AnswerTable means = means_table(), slopes = slopes_table();
    Answer answer;
    for (const std::string& column : request.columns) {
        const Rows rows = rows_in(*table_with(run, column), column, request.window);
        const Dimension dimension = dimension_of_column(scene, column);
        const Statistics all = statistics_of(rows.values);
        const Estimate mean = mean_estimate(rows.times, rows.values, steady_period(scene));
        means.rows.push_back({column, counted_cell(mean.rows), known(mean.value), known(mean.half_width),
                              known(all.deviation), known(all.least), known(all.most),
                              known(rows.values.back())});
        if (request.columns.size() > 1)
            means.row_dimensions.push_back(dimension);
        else
            for (std::size_t k = 2; k < means.columns.size(); ++k) means.columns[k].dimension = dimension;
        add_note(answer, column, mean, "mean");
        if (!request.slope) continue;
        const Estimate slope = slope_estimate(rows.times, rows.values);
        slopes.rows.push_back({column, counted_cell(slope.rows), known(slope.value), known(slope.half_width),
                               unit_per_second(dimension), rows.times.front(), rows.times.back()});
        add_note(answer, column, slope, "slope");
    }
    if (request.slope) answer.tables.push_back(std::move(slopes));
    answer.tables.push_back(std::move(means));
    return answer;
}

Answer by_period(const StoredRun& run, const ColumnsRequest& request) {
    const Scene& scene = run.known_scene();
    const double period = steady_period(scene);
    if (!(period > 0))
        throw UserError(
            scene.drive.present
                ? "the drive changes, so its periods have no one length; give --window in place of --by"
                : "the run has no drive, so there are no periods; give --window in place of --by");
    AnswerTable table{"by_period",
                      "Means of each period of the drive",
                      {{"period", Dimension::number, "from 0"},
                       {"from", Dimension::time, "begin of the period"},
                       {"rows", Dimension::number, ""}},
                      {}};
    for (const std::string& column : request.columns) {
        const Dimension dimension = dimension_of_column(scene, column);
        table.columns.push_back({column + "_mean", dimension, ""});
        table.columns.push_back({column + "_deviation", dimension, ""});
    }
    constexpr double rounding = 1e-6;  // share of a period, because times are rounded
    for (std::size_t k = 0; k < request.columns.size(); ++k) {
        const std::string& column = request.columns[k];
        const Rows rows = rows_in(*table_with(run, column), column, request.window);
        std::size_t row = 0;
        for (std::size_t begin = 0; begin < rows.times.size(); ++row) {
            const double number = std::floor(rows.times[begin] / period + rounding);
            std::size_t end = begin;
            while (end < rows.times.size() && rows.times[end] < (number + 1 - rounding) * period) ++end;
            const Statistics all =
                statistics_of(std::vector<double>(rows.values.begin() + static_cast<std::ptrdiff_t>(begin),
                                                  rows.values.begin() + static_cast<std::ptrdiff_t>(end)));
            if (k == 0)
                table.rows.push_back(
                    {static_cast<std::int64_t>(number), number * period, counted_cell(end - begin)});
            table.rows[row].push_back(known(all.mean));
            table.rows[row].push_back(known(all.deviation));
            begin = end;
        }
    }
    return {{std::move(table)}, {}};
}

}  // namespace

TimeWindow time_window(const std::string& text) {
    const std::size_t dots = text.find("..");
    if (dots == std::string::npos)
        throw UserError("\"{}\" must be two times with .. between them, as in 0.2s..0.8s", text);
    TimeWindow window;
    const auto time_in = [](const std::string& one) {
        const std::optional<double> seconds = number_in(one);
        return seconds ? *seconds : parse_quantity(one, Dimension::time);
    };
    const std::string from = text.substr(0, dots), to = text.substr(dots + 2);
    if (!from.empty()) window.from = time_in(from);
    if (!to.empty()) window.to = time_in(to);
    if (!(window.from < window.to))
        throw UserError("\"{}\" ends before it begins; exchange the two times", text);
    return window;
}

Answer columns_answer(const StoredRun& run, const ColumnsRequest& request) {
    return request.by_period ? by_period(run, request) : in_one(run, request);
}

}  // namespace grainreel
