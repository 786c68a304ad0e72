// What a study's charts show: points, which are what the seeds of each setting say, points from elsewhere
// (another paper, an experiment) beside them, and what is seen there in words (captions.cpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/app/study/file/members.hpp"
#include "render/app/study/results/summary.hpp"

namespace grainreel {

struct ChartPoint {
    double x = 0;  // in the axis' unit, divided by the chart's x_per; for an axis of words the number of the
                   // word, from 0
    SeedSummary y;
};

// So few values are drawn one by one beside their mean: an interval of two to four says little.
constexpr std::size_t few_values = 4;

// One line of a chart: all settings that differ in x alone.
struct ChartSeries {
    std::string name;                // "species.nut.diameter = 9 mm"; empty when there is one series alone
    std::vector<ChartPoint> points;  // by rising x
};
// All series of the chart, or those that it names.
std::vector<ChartSeries> chart_series(const Study& study, const std::vector<Member>& members,
                                      const std::vector<MemberResult>& results, const StudyChart& chart);

// Throws UserError when a chart names a series that the study does not have.
void check_series(const Study& study, const std::vector<Member>& members);

// What stands along the axes of a chart: "d of nut / 2 mm", "rise, mean (J)".
std::string x_title(const Study& study, const StudyChart& chart);
std::string y_title(const Study& study, const StudyChart& chart);

// A point from elsewhere, which a chart shows for comparison.
struct ReferencePoint {
    double x = 0, y = 0;  // in the units of the chart's axes
    double error = 0;     // error of y, half of the bar; 0 for none
};

// Reads the contents of a CSV file. Each row has x, y and, where it is known, the error of y; lines that
// begin with # and a first line of words are left out. Throws UserError, "file:line:column: ...", for
// anything else, and for a file without points. file: for messages.
std::vector<ReferencePoint> read_reference(const std::string& points_text, const std::filesystem::path& file);

// What is seen on a chart, in words: for the page, and as a caption for LaTeX.

// "mean", "median", "share".
const char* name_of(SeedAverage average);

// What points, bars, rings and open symbols of these series are, in sentences; none about what is not there.
std::vector<std::string> legend_sentences(SeedAverage average, const std::vector<ChartSeries>& series);

// The text of NAME.caption.tex: what is drawn against what, over how many seeds, and what the marks are. What
// has a meaning for LaTeX is escaped.
std::string chart_caption(const Study& study, const StudyChart& chart,
                          const std::vector<ChartSeries>& series);

}  // namespace grainreel
