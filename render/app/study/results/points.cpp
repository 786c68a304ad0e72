#include "render/app/study/results/points.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

namespace grainreel {
namespace {

struct Sample {
    std::vector<double> values;
    std::size_t members = 0;

    void add(const MemberResult& result, std::size_t measure) {
        if (result.state != MemberResult::State::complete) return;
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
        const std::string name = setting_text(study, members[m], chart.x);
        const std::size_t value = members[m].at[chart.x];
        const double x = axis.numeric ? axis.values[value].number : static_cast<double>(value);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        samples[{name, x}].add(results[m], chart.y);
    }
    std::vector<ChartSeries> all;
    for (const std::string& name : names) {
        ChartSeries series{name, {}};
        for (auto at = samples.lower_bound({name, -std::numeric_limits<double>::infinity()});
             at != samples.end() && at->first.first == name; ++at)
            series.points.push_back({at->first.second, mean_interval(at->second.values), at->second.members});
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
    if (interval.count == 1) return fmt::format("{:.4g}", interval.mean);
    return fmt::format("{:.4g} ± {:.2g}", interval.mean, interval.half);
}

}  // namespace grainreel
