// Parses texts with values of columns, and writes the values.
#include "render/scene/live_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/flow/beverloo.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

// The first columns of measures.csv count steps and time: those of the observer Times
// (engine/measure/observer_list.hpp).
constexpr std::size_t kCounters = 4;
constexpr std::string_view mean_name = "outflow_mean", law_name = "outflow_law";

// The unit that ends the name of a column: "J" of kinetic_J; empty for outflow_rate.
std::string unit_in_name(const MeasureColumn& column) {
    const std::string last = column.name.substr(column.name.rfind('_') + 1);
    return column.dimension != Dimension::number && unit_size_in(last, column.dimension) ? last : "";
}

// The rate of outflow that is no column: its mean, or what the law expects.
LiveWords rate_of(const std::string& name, const std::string& unit, const std::vector<MeasureColumn>& columns,
                  const Scene* scene) {
    if (find_column(columns, "outflow_kg") == nullptr)
        throw UserError(
            fmt::format("has {{{}}}, but no grain can leave; give the container an outlet", name));
    LiveWords value;
    value.column = "outflow_kg";
    value.what = name == law_name ? LiveWords::What::law : LiveWords::What::mean_rate;
    if (value.what == LiveWords::What::law) {
        const std::string why = scene == nullptr ? "there is no outlet" : why_no_beverloo(*scene);
        if (!why.empty())
            throw UserError(
                fmt::format("has {{{}}}, but Beverloo's law expects no rate here: {}", name, why));
        value.expected = *beverloo_rate(*scene);
    }
    value.unit = unit.empty() ? "kg/s" : unit;
    value.unit_size = unit_size(value.unit, Dimension::mass_flow);
    return value;
}

LiveWords value_of(const std::string& inside, const std::vector<MeasureColumn>& columns, const Scene* scene) {
    const std::size_t colon = inside.find(':');
    const std::string name = inside.substr(0, colon);
    if (name == mean_name || name == law_name)
        return rate_of(name, colon == std::string::npos ? "" : inside.substr(colon + 1), columns, scene);
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

std::vector<LiveWords> parse_live_text(const std::string& text, const std::vector<MeasureColumn>& columns,
                                       const Scene* scene) {
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
        all.push_back(value_of(text.substr(i + 1, end - i - 1), columns, scene));
        all.back().words = std::move(words);
        words.clear();
        i = end + length_of_unit(std::string_view(text).substr(end + 1), all.back().unit);
    }
    if (!words.empty()) all.emplace_back().words = std::move(words);
    return all;
}

std::optional<double> live_number(const LiveWords& part, const MeasureTable* table, std::size_t rows) {
    if (part.what == LiveWords::What::law) return part.expected;
    const auto column = table != nullptr && rows > 0 ? table->find(part.column) : std::nullopt;
    if (!column) return std::nullopt;
    if (part.what == LiveWords::What::last) return table->values(*column, rows - 1, rows).front();
    const auto time = table->find("time_s");
    if (!time) return std::nullopt;
    return mean_outflow_rate(table->values(*time, 0, rows), table->values(*column, 0, rows));
}

std::string live_value(const std::optional<double>& value, const LiveWords& as) {
    const std::string unit = as.unit.empty() ? "" : " " + as.unit;
    if (!value || !std::isfinite(*value)) return "–" + unit;
    const double shown = *value / as.unit_size;
    return (shown < 0 ? "−" : "") + fmt::format("{:.3g}", std::abs(shown)) + unit;
}

}  // namespace grainreel
