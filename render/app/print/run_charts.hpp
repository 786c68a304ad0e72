// Draws measures of runs against time, as charts for print.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "render/app/print/paper.hpp"

namespace grainreel {

// Draws a chart for each measure, with a line for each run, into `folder`, which is made. names: those that
// the user gave the runs, or none. measures: columns of measures.csv; none: those that the runs' page shows
// at first; "all": all that have values. Beside each chart lie its table, in SI units, and its commands.
// Returns the charts' files. Throws UserError for runs without measures and for columns that they lack.
std::vector<std::filesystem::path> draw_run_charts(const std::vector<std::filesystem::path>& runs,
                                                   const std::vector<std::string>& names,
                                                   const std::vector<std::string>& measures,
                                                   const Paper& paper, const std::filesystem::path& folder);

// A curve as rows of a chart's table: "number,x,y,name", or without the name where it is empty. A value that
// is not finite leaves an empty line, which breaks gnuplot's curve. A curve of more than kMostCurvePoints
// points is thinned to what a line of this length can show: it is divided into equal parts, and the first,
// the lowest, the highest and the last point of each part stay.
std::string curve_table(std::size_t number, const std::vector<double>& x, const std::vector<double>& y,
                        const std::string& name);

constexpr std::size_t kMostCurvePoints = 8000;

}  // namespace grainreel
