// The columns of measures.csv: which observer gives which, and how each is drawn. Needs no state and no step
// loop, so that scenes can be read and frames drawn with it.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/output.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct ObserverColumns {
    const char* instrument;  // that a scene asks for by name; null: none
    std::vector<ColumnGroup> (*groups)(const Scene& scene);
};
// In the order of their columns.
const std::vector<ObserverColumns>& observer_columns();

// The columns of all observers, also of instruments that the scene does not ask for.
std::vector<MeasureColumn> measure_columns(const Scene& scene);
// These columns and the names of the instruments, for the reader of a scene.
Measurable measurable_in(const Scene& scene);

// The table of all columns in Markdown, as in docs/reference/scenes.md.
std::string column_table_markdown();

// The axis on which a column of measures.csv is drawn.
struct ColumnAxis {
    bool from_zero = false;  // it cannot be negative: the axis begins at 0
    double expected = 0;     // SI, how large it gets by the scene, roughly; 0: not known
};

ColumnAxis axis_of_column(const Scene& scene, const std::string& column);

// Columns that cannot be negative, but for those that have a species' name.
const std::vector<std::string>& columns_from_zero();

}  // namespace grainreel
