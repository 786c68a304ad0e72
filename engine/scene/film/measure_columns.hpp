// The columns of measures.csv: their names there, what to call them where people read, and what they are.
// They are those of the observers in engine/measure/observer_list.hpp.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

struct MeasureColumn {
    std::string name;   // "kinetic_J": the unit, when there is one, comes last
    std::string label;  // "kinetic energy"
    Dimension dimension = Dimension::number;
};

// Columns that share a line of the documentation.
struct ColumnGroup {
    std::vector<MeasureColumn> columns;
    const char* unit;   // of the documentation: "J", "turns, 0 to 1"
    const char* about;  // Markdown
};

// species: their names, in the scene's order.
std::vector<MeasureColumn> measure_columns(const std::vector<std::string>& species);

// A species' name as a part of a column's name.
std::string column_part(const std::string& name);

// The table of all columns in Markdown, as in docs/reference/scenes.md.
std::string column_table_markdown();

}  // namespace grainreel
