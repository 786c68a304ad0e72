// Points from elsewhere that are drawn on a study's chart.
#pragma once

#include <filesystem>
#include <vector>

namespace grainreel {

struct ReferencePoint {
    double x = 0, y = 0;  // in the units of the chart's axes
    double error = 0;     // error of y, half of the bar; 0 for none
};

// Reads a CSV file. Each row has x, y and, where it is known, the error of y; lines that begin with # and a
// first line of words are left out. Throws UserError, "file:line:column: ...", for anything else, and for a
// file without points or larger than 16 MiB.
std::vector<ReferencePoint> read_reference(const std::filesystem::path& file);

}  // namespace grainreel
