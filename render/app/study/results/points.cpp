#include "render/app/study/results/points.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {
namespace {

struct Sample {
    std::vector<double> values;
    std::size_t members = 0;

    void add(const MemberResult& result, std::size_t measure) {
        if (result.status != MemberResult::Status::complete) return;
        ++members;
        values.push_back(result.values[measure]);
    }
};

}  // namespace

std::vector<ChartSeries> chart_series(const Study& study, const std::vector<Member>& members,
                                      const std::vector<MemberResult>& results, const StudyChart& chart) {
    const Variation& axis = study.variations[chart.x];
    std::vector<std::string> names;  // in order of appearance
    std::map<std::pair<std::string, double>, Sample> samples;
    for (std::size_t m = 0; m < members.size(); ++m) {
        const std::string name = shown_setting(study, members[m], chart.x);
        const std::size_t value = members[m].at[chart.x];
        const double x = axis.numeric ? axis.values[value].number : static_cast<double>(value);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        samples[{name, x}].add(results[m], chart.y);
    }
    std::vector<ChartSeries> all;
    for (const std::string& name : names) {
        ChartSeries series{name, {}};
        for (auto at = samples.lower_bound({name, -std::numeric_limits<double>::infinity()});
             at != samples.end() && at->first.first == name; ++at) {
            std::vector<double> finite = at->second.values;
            std::erase_if(finite, [](double value) { return !std::isfinite(value); });
            series.points.push_back(
                {at->first.second, mean_interval(at->second.values), at->second.members, std::move(finite)});
        }
        all.push_back(std::move(series));
    }
    return all;
}

MeanInterval setting_interval(const std::vector<Member>& members, const std::vector<MemberResult>& results,
                              std::size_t setting, std::size_t measure) {
    Sample sample;
    const auto first = std::partition_point(members.begin(), members.end(),
                                            [&](const Member& m) { return m.setting < setting; });
    for (auto m = first; m != members.end() && m->setting == setting; ++m)
        sample.add(results[static_cast<std::size_t>(m - members.begin())], measure);
    return mean_interval(sample.values);
}

std::string interval_text(const MeanInterval& interval) {
    if (interval.count == 0) return "–";
    const auto with_minus = [](std::string text) {
        return text.starts_with('-') ? "−" + text.substr(1) : text;
    };
    if (interval.count == 1) return with_minus(fmt::format("{:.4g}", interval.mean));
    const double half = interval.half;
    if (!(half > 0) || !std::isfinite(half))
        return fmt::format("{} ± {:.2g}", with_minus(fmt::format("{:.4g}", interval.mean)), half);
    // Two digits of the half: 0.0312 has three decimals, 312 is rounded to tens.
    const int decimals = 1 - static_cast<int>(std::floor(std::log10(half) + 1e-12));
    const double digit = std::pow(10, -decimals);
    const auto rounded = [&](double value) {
        const double shown = std::round(value / digit) * digit;
        return with_minus(fmt::format("{:.{}f}", shown == 0 ? 0 : shown, std::max(0, decimals)));
    };
    if (std::abs(interval.mean) >= 1e6 || half < 1e-4)
        return fmt::format("{} ± {:.2g}", with_minus(fmt::format("{:.4g}", interval.mean)), half);
    return fmt::format("{} ± {}", rounded(interval.mean), rounded(half));
}

std::vector<ReferencePoint> read_reference(const std::filesystem::path& file) {
    std::istringstream text(load_scene_file(file));
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
    if (points.empty()) throw UserError(fmt::format("{}: has no points; a row has x and y", file.string()));
    return points;
}

}  // namespace grainreel
