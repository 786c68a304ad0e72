// Words of the user's own with values that change from frame to frame:
//   "mixing {lacey}\nkinetic energy {kinetic:mJ}"
// A value is a column of measures.csv, named with or without its unit, and has three significant digits.
// After a colon stands the unit in which it is shown, % for a pure number; without a colon, that is the unit
// in the column's name.
// Two values are no columns: outflow_mean, the mean rate of what has run out, and outflow_law, the rate that
// Beverloo's law expects (engine/measure/flow/beverloo.hpp). "{{" stands for a brace.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/scene/measurable.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Words and the value that follows them. Words after the last value have an empty `column`.
struct LiveWords {
    std::string words;
    std::string column;    // column of measures.csv; empty: no value
    std::string unit;      // shown after the value; empty for a pure number
    double unit_size = 1;  // SI
    // The last value of the column; of outflow_kg also its mean rate, or what the law expects.
    enum class What { last, mean_rate, law } what = What::last;
    double expected = 0;  // SI, of the law
    bool operator==(const LiveWords&) const = default;
};

inline bool has_values(const std::vector<LiveWords>& all) {
    for (const LiveWords& part : all)
        if (!part.column.empty()) return true;
    return false;
}

// The column that a name means, with or without its unit ("kinetic_J", "kinetic"); null when there is none.
// The columns that count steps and time are not searched.
const MeasureColumn* find_column(const std::vector<MeasureColumn>& columns, const std::string& name);
// "lacey, kinetic_J, ...": the names of the columns that are always there.
std::string column_names(const std::vector<MeasureColumn>& columns);

// Splits a text into words and values. scene: for which the law expects a rate; null: none. Throws a
// UserError that says what is wrong with the text.
std::vector<LiveWords> parse_live_text(const std::string& text, const std::vector<MeasureColumn>& columns,
                                       const Scene* scene = nullptr);

// The value that a part shows after the first `rows` rows of a table, which may be null. None where it is not
// known yet.
std::optional<double> live_number(const LiveWords& part, const MeasureTable* table, std::size_t rows);

// Writes the text with its values. value(part): the value that a part shows; none where it is not known yet.
template <class ValueOf>
std::string live_text(const std::vector<LiveWords>& all, const ValueOf& value);
// A value with its unit; a dash in its place if there is none.
std::string live_value(const std::optional<double>& value, const LiveWords& as);

template <class ValueOf>
std::string live_text(const std::vector<LiveWords>& all, const ValueOf& value) {
    std::string text;
    for (const LiveWords& part : all) {
        text += part.words;
        if (!part.column.empty()) text += live_value(value(part), part);
    }
    return text;
}

}  // namespace grainreel
