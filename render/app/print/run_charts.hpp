// Measures of runs against time, as charts for print.
#pragma once

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

}  // namespace grainreel
