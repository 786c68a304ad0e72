// Draws a study's charts: for each one it writes a table and commands, from which gnuplot makes the pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/app/print/paper.hpp"
#include "render/app/study/results/points.hpp"

namespace grainreel {

// The stem of the chart's files, NAME.csv, NAME.gp, NAME.svg and NAME.png.
std::string chart_stem(const StudyChart& chart);

// The table of a chart, "series,x,mean,low,high,values,members,name,of_some,bound", with a row for each
// point; the third column is called by what the seeds are joined to. gnuplot's commands count on this order
// of columns. low and high are the ends of the 95 % interval, and of_some is what is drawn open.
std::string chart_table(const std::vector<ChartSeries>& series, SeedAverage average = SeedAverage::mean);

// The single values of points that have few of them, "series,x,value", in NAME.seeds.csv.
bool has_seeds(const std::vector<ChartSeries>& series);
std::string seed_table(const std::vector<ChartSeries>& series);

// The commands for gnuplot. They run in the table's folder, where points from elsewhere lie in
// NAME.reference.csv.
std::string chart_commands(const Study& study, const StudyChart& chart,
                           const std::vector<ChartSeries>& series, bool has_reference);

// The commands for the axes (axes.cpp): marks of logarithmic axes and of very small or large numbers, and the
// range where all points are equally high.

// "5·10⁻⁵"; "10⁻⁵" for a power of ten.
std::string power_text(double value);

// Marks of both axes, where gnuplot's own do not serve: a logarithmic axis goes from the next 1, 2 or 5 times
// a power of ten below its points to the next one above them.
std::string axis_marks(const Study& study, const StudyChart& chart, const std::vector<ChartSeries>& series);

// The range along y for points that are all equally high, for which gnuplot would show a thousandth of their
// height; empty for others.
std::string range_of_one_height(const StudyMeasure& measure, const std::vector<ChartSeries>& series);

// What a search found so far: a grey band along x, and a broken line at the wanted value. Empty on charts of
// other measures.
std::string search_marks(const Study& study, const StudyChart& chart);

struct DrawnCharts {
    bool drawn = true;  // false: gnuplot is missing or has failed
    std::vector<std::string> stems;
};
// Writes tables and commands into `folder`, which it makes, and runs gnuplot. For a chart without a single
// point it writes the table alone. references: for each chart its points from elsewhere; empty for none.
DrawnCharts draw_charts(const Study& study, const std::vector<Member>& members,
                        const std::vector<MemberResult>& results,
                        const std::vector<std::vector<ReferencePoint>>& references,
                        const std::filesystem::path& folder);

// Draws the same charts for print and returns their files. Throws UserError when the folder cannot be made,
// RunError when there is no gnuplot.
std::vector<std::filesystem::path> print_charts(const Study& study, const std::vector<Member>& members,
                                                const std::vector<MemberResult>& results,
                                                const std::vector<std::vector<ReferencePoint>>& references,
                                                const Paper& paper, const std::filesystem::path& folder);

}  // namespace grainreel
