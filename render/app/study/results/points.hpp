// The points of a study's charts: means over seeds with their 95 % intervals, and points from elsewhere
// (another paper, an experiment) that are drawn beside them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/questions/statistics.hpp"
#include "render/app/study/file/members.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {

struct ChartPoint {
    double x = 0;  // in the axis' unit; for an axis of words the number of the word, from 0
    MeanInterval y;
    std::size_t members = 0;          // number of complete members; y.count of them have a value
    std::vector<double> values = {};  // of the seeds; those that are not finite are left out
};

// So few values are drawn one by one beside their mean: an interval of two to four says little.
constexpr std::size_t few_values = 4;

// One line of a chart: all settings that differ in x alone.
struct ChartSeries {
    std::string name;                // "species.nut.diameter = 9 mm"; empty when there is one series alone
    std::vector<ChartPoint> points;  // by rising x
};
std::vector<ChartSeries> chart_series(const Study& study, const std::vector<Member>& members,
                                      const std::vector<MemberResult>& results, const StudyChart& chart);

// The interval of a measure over the seeds of a setting. members: in the order of make_members().
MeanInterval setting_interval(const std::vector<Member>& members, const std::vector<MemberResult>& results,
                              std::size_t setting, std::size_t measure);

// The interval as text: "0.412 ± 0.031", the mean and half of its 95 % interval. The half has two digits, and
// the mean as many decimals. For one value it is the value alone, for none a dash.
std::string interval_text(const MeanInterval& interval);

// A point from elsewhere, which a chart shows for comparison.
struct ReferencePoint {
    double x = 0, y = 0;  // in the units of the chart's axes
    double error = 0;     // error of y, half of the bar; 0 for none
};

// Reads a CSV file. Each row has x, y and, where it is known, the error of y; lines that begin with # and a
// first line of words are left out. Throws UserError, "file:line:column: ...", for anything else, and for a
// file without points or larger than 16 MiB.
std::vector<ReferencePoint> read_reference(const std::filesystem::path& file);

}  // namespace grainreel
