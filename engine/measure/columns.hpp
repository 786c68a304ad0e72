// The columns of measures.csv, with the observer that gives each and the axis on which it is drawn. This
// header does not need a state or the step loop, so code that reads scenes or draws frames can use it.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

struct ObserverColumns {
    const char* instrument;  // instrument that a scene asks for by name, or null
    std::vector<ColumnGroup> (*groups)(const Scene& scene);
    // Why a column has no value at any moment of a scene; empty where it may have one. Null: it always may.
    std::string (*why_empty)(const Scene& scene, const std::string& column) = nullptr;
};
// All observers in the order of their columns.
const std::vector<ObserverColumns>& observer_columns();

// The columns of all observers, also of instruments that the scene does not ask for.
std::vector<MeasureColumn> measure_columns(const Scene& scene);
// The columns of all observers and the names of all instruments. The reader of a scene looks names up in it.
Measurable measurable_in(const Scene& scene);

// Why a column has no value in any row of the scene's measures.csv: "it compares two species, and there is
// one". Empty where it may have values.
std::string why_column_is_empty(const Scene& scene, const std::string& column);

// The table of all columns in Markdown, as in docs/reference/measures.md.
std::string column_table_markdown();

// The axis on which a column of measures.csv is drawn.
struct ColumnAxis {
    bool from_zero = false;  // true if the value cannot be negative, so that the axis begins at 0
    double expected = 0;     // SI, rough size of the value, estimated from the scene; 0 if not known
};

ColumnAxis axis_of_column(const Scene& scene, const std::string& column);

// The columns that cannot be negative; columns.cpp lists them. Columns with the name of a species
// are not in this list, but axis_of_column() knows them.
const std::vector<std::string>& columns_from_zero();

}  // namespace grainreel
