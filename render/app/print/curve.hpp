// A curve as rows of a chart's table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace grainreel {

// Rows "number,x,y,name", or without the name where it is empty. A value that is none leaves an empty line,
// which breaks gnuplot's line. Of more than kMostCurvePoints points those stay that a line of this length
// shows: of each of so many equal parts the first, the lowest, the highest and the last.
std::string curve_table(std::size_t number, const std::vector<double>& x, const std::vector<double>& y,
                        const std::string& name);

constexpr std::size_t kMostCurvePoints = 8000;

}  // namespace grainreel
