// What is seen on a study's charts, in words: for the page, and as a caption for LaTeX.
#pragma once

#include <string>
#include <vector>

#include "render/app/study/results/points.hpp"

namespace grainreel {

// "mean", "median", "share".
const char* name_of(SeedAverage average);

// What points, bars, rings and open symbols of these series are, in sentences; none about what is not there.
std::vector<std::string> legend_sentences(SeedAverage average, const std::vector<ChartSeries>& series);

// The text of NAME.caption.tex: what is drawn against what, over how many seeds, and what the marks are. What
// has a meaning for LaTeX is escaped.
std::string chart_caption(const Study& study, const StudyChart& chart,
                          const std::vector<ChartSeries>& series);

}  // namespace grainreel
