// Words of the user's own with values that change from frame to frame:
//   "mixing {lacey}\nkinetic energy {kinetic:mJ}"
// A value is a column of measures.csv, with or without its unit, and after a colon the unit to show it in; SI
// without. Three significant digits. "{{" is a brace.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/output.hpp"

namespace grainreel {

// Words, and then a value; the last ones have none.
struct LiveWords {
    std::string words;
    std::string column;    // of measures.csv; empty for none
    std::string unit;      // shown after the value; empty for a pure number
    double unit_size = 1;  // SI
    bool operator==(const LiveWords&) const = default;
};

// The column that a name means, with or without its unit ("kinetic_J", "kinetic"); null for none. Those that
// count steps and time mean nothing here.
const MeasureColumn* find_column(const std::vector<MeasureColumn>& columns, const std::string& name);
// "lacey, kinetic_J, ...": those that are always there.
std::string column_names(const std::vector<MeasureColumn>& columns);

// Throws UserError, which says what is wrong with the text.
std::vector<LiveWords> parse_live_text(const std::string& text, const std::vector<MeasureColumn>& columns);

// value(column): of a row of measures.csv, none when there is no row yet.
template <class ValueOf>
std::string live_text(const std::vector<LiveWords>& all, const ValueOf& value);
std::string live_value(const std::optional<double>& value, const LiveWords& as);

template <class ValueOf>
std::string live_text(const std::vector<LiveWords>& all, const ValueOf& value) {
    std::string text;
    for (const LiveWords& part : all) {
        text += part.words;
        if (!part.column.empty()) text += live_value(value(part.column), part);
    }
    return text;
}

}  // namespace grainreel
