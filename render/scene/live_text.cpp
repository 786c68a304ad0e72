// Parses texts with values of columns, and writes the values.
#include "render/scene/live_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

// The first columns of measures.csv count steps and time: those of the observer Times
// (engine/measure/observer_list.hpp).
constexpr std::size_t kCounters = 4;

// The unit that ends the name of a column: "J" of kinetic_J; empty for outflow_rate.
std::string unit_in_name(const MeasureColumn& column) {
    const std::string last = column.name.substr(column.name.rfind('_') + 1);
    return column.dimension != Dimension::number && unit_size_in(last, column.dimension) ? last : "";
}

LiveWords value_of(const std::string& inside, const std::vector<MeasureColumn>& columns) {
    const std::size_t colon = inside.find(':');
    const std::string name = inside.substr(0, colon);
    const MeasureColumn* column = find_column(columns, name);
    if (column == nullptr)
        throw UserError("has {{{}}}, which is no column of measures.csv; there are {}", excerpt(name),
                        column_names(columns));
    LiveWords value;
    value.column = column->name;
    if (column->dimension == Dimension::number) {
        if (colon != std::string::npos && inside.substr(colon + 1) == "%") {
            value.unit = "%";
            value.unit_size = 0.01;
            return value;
        }
        if (colon != std::string::npos)
            throw UserError("gives {{{}}} a unit, but it is a pure number; leave it out, or write %", name);
        return value;
    }
    const std::string own = unit_in_name(*column);
    value.unit = colon != std::string::npos ? inside.substr(colon + 1)
                 : own.empty()              ? text_of(column->dimension).unit
                                            : own;
    value.unit_size = unit_size(value.unit, column->dimension);
    return value;
}

// The length of the unit that a value brings along, where it stands behind the value once more: 2 for " g of
// sand" and "g"; else 0.
std::size_t length_of_unit(std::string_view behind, std::string_view unit) {
    const std::size_t blanks = std::min(behind.find_first_not_of(' '), behind.size());
    const std::string_view word = behind.substr(blanks);
    if (unit.empty() || !word.starts_with(unit)) return 0;
    const std::string_view rest = word.substr(unit.size());
    const bool ends =
        rest.empty() || std::string_view(" \n,;.:!?)").find(rest.front()) != std::string_view::npos;
    return ends ? blanks + unit.size() : 0;
}

}  // namespace

const MeasureColumn* find_column(const std::vector<MeasureColumn>& columns, const std::string& name) {
    for (std::size_t i = kCounters; i < columns.size(); ++i) {
        const std::string& full = columns[i].name;
        const bool has_unit = !unit_in_name(columns[i]).empty();
        if (full == name || (has_unit && full.substr(0, full.rfind('_')) == name)) return &columns[i];
    }
    return nullptr;
}

std::string column_names(const std::vector<MeasureColumn>& columns) {
    std::string known;
    for (std::size_t i = kCounters; i < columns.size(); ++i)
        if (columns[i].instrument.empty()) known += (known.empty() ? "" : ", ") + columns[i].name;
    return known + ", and those of the instruments (docs/reference/measures.md)";
}

std::vector<LiveWords> parse_live_text(const std::string& text, const std::vector<MeasureColumn>& columns) {
    std::vector<LiveWords> all;
    std::string words;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '{' || text.compare(i, 2, "{{") == 0) {
            words += text[i];
            i += text[i] == '{' ? 1 : 0;
            continue;
        }
        const std::size_t end = text.find('}', i);
        if (end == std::string::npos)
            throw UserError("has a { without its }; write {lacey} for a value, or {{ for a brace");
        all.push_back(value_of(text.substr(i + 1, end - i - 1), columns));
        all.back().words = std::move(words);
        words.clear();
        i = end + length_of_unit(std::string_view(text).substr(end + 1), all.back().unit);
    }
    if (!words.empty()) all.push_back({std::move(words), "", "", 1});
    return all;
}

std::string live_value(const std::optional<double>& value, const LiveWords& as) {
    const std::string unit = as.unit.empty() ? "" : " " + as.unit;
    if (!value || !std::isfinite(*value)) return "–" + unit;
    const double shown = *value / as.unit_size;
    return (shown < 0 ? "−" : "") + fmt::format("{:.3g}", std::abs(shown)) + unit;
}

}  // namespace grainreel
