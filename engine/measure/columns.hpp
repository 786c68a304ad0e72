// What all observers of observer_list.hpp give, without a state and without the step loop: what is known
// where a scene is read or a frame is drawn.
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

// The columns of all of them, those of instruments that the scene does not ask for among them.
std::vector<MeasureColumn> measure_columns(const Scene& scene);
// They, and the instruments' names, for the reader of a scene.
Measurable measurable_in(const Scene& scene);

// The table of all columns in Markdown, as in docs/reference/scenes.md.
std::string column_table_markdown();

// What axis a column of measures.csv takes where it is drawn.
struct ColumnAxis {
    bool from_zero = false;  // it cannot be negative: the axis begins at 0
    double expected = 0;     // SI, about how large it gets, by the scene; 0 where nobody knows
};

ColumnAxis axis_of_column(const Scene& scene, const std::string& column);

// Columns that cannot be negative, but for those that have a species' name.
const std::vector<std::string>& columns_from_zero();

}  // namespace grainreel
