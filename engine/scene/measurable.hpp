// The columns that measures.csv can have, as plain values.
//
// The observers decide which columns there are (engine/measure/observer_list.hpp). The reader of a scene gets
// the list, because plots and live words (numbers shown in a film) name columns.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

struct Scene;

struct MeasureColumn {
    std::string name;   // "kinetic_J": the unit, when there is one, comes last
    std::string label;  // "kinetic energy"
    Dimension dimension = Dimension::number;
    std::string instrument = {};  // entry of output.instruments that the column needs; empty: none
    bool operator==(const MeasureColumn&) const = default;
};

// Columns that share a line of the documentation.
struct ColumnGroup {
    std::vector<MeasureColumn> columns;
    const char* unit;   // as in the documentation: "J", "turns, 0 to 1"
    const char* about;  // Markdown
};

// What can be measured in a scene: all columns that its measures.csv can have, in their order, and the
// instruments, which are measurements that a scene must ask for by name.
struct Measurable {
    std::vector<MeasureColumn> columns;
    std::vector<std::string> instruments;
};
// Gives the columns for a scene that has been read except for its film.
using MeasurableIn = std::function<Measurable(const Scene&)>;

// Gives a species' name as a part of a column's name. Quotes and separators of CSV are replaced, because they
// would break the row.
inline std::string column_part(const std::string& name) {
    std::string result = name;
    for (char& c : result) {
        if (c == ',' || c == '"' || c == '\n' || c == '\r') c = '_';
    }
    return result;
}

}  // namespace grainreel
