// The columns of measures.csv: their names there, what to call them where people read, and what they are.
//
// Which there are is said by the observers (engine/measure/observer_list.hpp). The reader of a scene is told
// them, because plots and live words name them.
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
    std::string instrument = {};  // of output.instruments, without which there is no such column; empty: none
    bool operator==(const MeasureColumn&) const = default;
};

// Columns that share a line of the documentation.
struct ColumnGroup {
    std::vector<MeasureColumn> columns;
    const char* unit;   // of the documentation: "J", "turns, 0 to 1"
    const char* about;  // Markdown
};

// What can be measured in a scene: all columns that its measures.csv can have, in their order, and the
// instruments, which a scene asks for by name.
struct Measurable {
    std::vector<MeasureColumn> columns;
    std::vector<std::string> instruments;
};
// The scene has all but its film by then.
using MeasurableIn = std::function<Measurable(const Scene&)>;

// A species' name as a part of a column's name.
std::string column_part(const std::string& name);

}  // namespace grainreel
