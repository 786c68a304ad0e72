// The axes of a study's chart as commands for gnuplot: marks of logarithmic axes and of very small or large
// numbers, and the range where all points are equally high.
#pragma once

#include <string>
#include <vector>

#include "render/app/study/results/points.hpp"

namespace grainreel {

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

}  // namespace grainreel
