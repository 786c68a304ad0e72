// Measures of runs against time, as charts for print.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "render/app/print/paper.hpp"

namespace grainreel {

// A chart for each measure, with a line for each run, into `folder`, which is made. measures: columns of
// measures.csv; none: those that the runs' page begins with; "all": all that have values. Beside each chart
// lie its table, in SI units, and its commands. Gives the charts' files. Throws UserError for runs without
// measures and for columns that they have not.
std::vector<std::filesystem::path> draw_run_charts(const std::vector<std::filesystem::path>& runs,
                                                   const std::vector<std::string>& measures,
                                                   const Paper& paper, const std::filesystem::path& folder);

// A curve as rows of a chart's table: "number,x,y,name", or without the name where it is empty. A value that
// is none leaves an empty line, which breaks gnuplot's line. Of more than kMostCurvePoints points those stay
// that a line of this length shows: of each of so many equal parts the first, the lowest, the highest and the
// last.
std::string curve_table(std::size_t number, const std::vector<double>& x, const std::vector<double>& y,
                        const std::string& name);

constexpr std::size_t kMostCurvePoints = 8000;

}  // namespace grainreel
