#include "render/app/study/results/points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <sstream>

#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

std::vector<ChartSeries> chart_series(const Study& study, const std::vector<Member>& members,
                                      const std::vector<MemberResult>& results, const StudyChart& chart) {
    const Variation& axis = study.variations[chart.x];
    std::vector<std::string> names;  // in order of appearance
    std::map<std::pair<std::string, double>, std::vector<SeedValue>> seeds;
    for (std::size_t m = 0; m < members.size(); ++m) {
        const std::string name = shown_setting(study, members[m], chart.x);
        const std::size_t value = members[m].at[chart.x];
        const double x =
            axis.numeric ? shown_x(study, chart, axis.values[value].number) : static_cast<double>(value);
        if (!contains(names, name)) names.push_back(name);
        std::vector<SeedValue>& of_point = seeds[{name, x}];
        if (results[m].status == MemberResult::Status::complete)
            of_point.push_back(results[m].seed_value(chart.y));
    }
    if (!chart.series.empty()) names = chart.series;
    std::vector<ChartSeries> all;
    for (const std::string& name : names) {
        ChartSeries series{name, {}};
        for (auto point = seeds.lower_bound({name, -std::numeric_limits<double>::infinity()});
             point != seeds.end() && point->first.first == name; ++point)
            series.points.push_back(
                {point->first.second, scaled(summary_of_measure(study.measures[chart.y], point->second),
                                             unit_of_y(study, chart).factor)});
        all.push_back(std::move(series));
    }
    return all;
}

void check_series(const Study& study, const std::vector<Member>& members) {
    for (const StudyChart& chart : study.charts) {
        std::vector<std::string> names;
        for (const Member& member : members) {
            const std::string name = shown_setting(study, member, chart.x);
            if (!contains(names, name)) names.push_back(name);
        }
        for (const std::string& name : chart.series)
            if (!contains(names, name))
                throw UserError("{}: names a series \"{}\"; the chart has {}", chart.series_place,
                                excerpt(name),
                                names.size() == 1 && names[0].empty()
                                    ? "one alone, without a name"
                                    : excerpt(fmt::format("{}", fmt::join(names, "; "))));
    }
}

std::string x_title(const Study& study, const StudyChart& chart) {
    const Variation& axis = study.variations[chart.x];
    if (chart.x_per_words.empty())
        return axis_title(chart.x_label.empty() ? axis.shown : chart.x_label, unit_of_x(study, chart).unit);
    return chart.x_label.empty() ? fmt::format("{} / {}", axis.shown, chart.x_per_words) : chart.x_label;
}

std::string y_title(const Study& study, const StudyChart& chart) {
    const StudyMeasure& measure = study.measures[chart.y];
    if (!chart.y_label.empty()) return axis_title(chart.y_label, unit_of_y(study, chart).unit);
    const bool said =
        measure.average != SeedAverage::median || measure.label.find("median") != std::string::npos;
    return axis_title(said ? measure.label : measure.label + ", median", unit_of_y(study, chart).unit);
}

std::vector<ReferencePoint> read_reference(const std::string& points_text,
                                           const std::filesystem::path& file) {
    std::istringstream text(points_text);
    CsvRows rows(text, file, {.remarks = "#"});
    std::vector<ReferencePoint> points;
    const auto fail = [&](std::size_t column, const std::string& what) {
        rows.fail(column, what + "; a row has x, y and, where it is known, the error of y");
    };
    for (bool may_be_heading = true; rows.next(); may_be_heading = false) {
        const std::vector<CsvCell>& cells = rows.cells();
        if (may_be_heading && !number_in(cells[0].text)) continue;
        if (cells.size() < 2 || cells.size() > 3) fail(1, fmt::format("there are {} numbers", cells.size()));
        double values[3] = {};
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto value = number_in(cells[i].text);
            if (!value) fail(cells[i].column, fmt::format("\"{}\" is no number", excerpt(cells[i].text)));
            values[i] = *value;
        }
        if (values[2] < 0) fail(cells[2].column, "the error of y is negative");
        points.push_back({values[0], values[1], values[2]});
    }
    if (points.empty()) throw UserError("{}: has no points; a row has x and y", file.string());
    return points;
}

}  // namespace grainreel
