// A study's charts on disk: a table each, the commands for gnuplot that draw it, and what it makes of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/app/print/paper.hpp"
#include "render/app/study/results/points.hpp"
#include "render/app/study/results/reference.hpp"

namespace grainreel {

// The stem of the chart's files, NAME.csv, NAME.gp, NAME.svg and NAME.png.
std::string chart_stem(const StudyChart& chart);

// "series,x,mean,low,high,values,members": a row a point; low and high are the ends of the 95 % interval.
std::string chart_table(const std::vector<ChartSeries>& series);

// To be run in the folder of the table, with the reference beside it as NAME.reference.csv.
std::string chart_commands(const Study& study, const StudyChart& chart,
                           const std::vector<ChartSeries>& series, bool has_reference);

struct DrawnCharts {
    bool drawn = true;  // false: gnuplot is missing or has failed
    std::vector<std::string> stems;
};
// Writes tables and commands into `folder`, which it makes, and runs gnuplot. A chart without a single point
// is left out. references: of each chart, empty for none.
DrawnCharts draw_charts(const Study& study, const std::vector<Member>& members,
                        const std::vector<MemberResult>& results,
                        const std::vector<std::vector<ReferencePoint>>& references,
                        const std::filesystem::path& folder);

// The same charts for print. Gives their files. Throws UserError where the folder cannot be made, RunError
// without gnuplot.
std::vector<std::filesystem::path> print_charts(const Study& study, const std::vector<Member>& members,
                                                const std::vector<MemberResult>& results,
                                                const std::vector<std::vector<ReferencePoint>>& references,
                                                const Paper& paper, const std::filesystem::path& folder);

}  // namespace grainreel
