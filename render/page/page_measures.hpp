// The measures as the page has them: which columns have a chart at first, and their values.
#pragma once

#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct PageColumn {
    std::string name;   // as in measures.csv
    std::string label;  // in words
    std::string unit;   // SI; empty for pure numbers
};

struct PageMeasures {
    std::vector<PageColumn> columns;   // all of measures.csv, in its order
    std::vector<std::size_t> charted;  // of them those with a chart at first
    std::vector<std::size_t> rows;     // those that the page has at once, evenly spread
    std::size_t time = 0;              // the column of time
};

// Rows of so many, at most so many, evenly spread, the first and the last among them.
std::vector<std::size_t> spread_rows(std::size_t rows, std::size_t most);

constexpr std::size_t kMostRowsAtOnce = 2000;

// The film's plots come first, then the measures that usually matter, as far as they have values that change.
// Nothing is charted without a column of time.
PageMeasures page_measures(const FilmedScene& scene, const MeasureTable& table);

}  // namespace grainreel
