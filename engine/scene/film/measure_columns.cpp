#include "engine/scene/film/measure_columns.hpp"

#include <fmt/format.h>

#include "engine/measure/observer_list.hpp"

namespace grainreel {
namespace {

// Of these classes only columns() is used here, which needs nothing of the libraries above.
template <class... Each>
std::vector<ColumnGroup> groups_of(ObserverList<Each...>, const std::vector<std::string>& species) {
    std::vector<ColumnGroup> all;
    const auto add = [&](std::vector<ColumnGroup> groups) {
        for (ColumnGroup& group : groups) all.push_back(std::move(group));
    };
    (add(Each::columns(species)), ...);
    return all;
}

std::string names_of(const std::vector<MeasureColumn>& columns) {
    const std::string first = fmt::format("`{}`", columns.front().name);
    if (columns.size() == 1) return first;
    return fmt::format("{}{}`{}`", first, columns.size() > 2 ? " to " : ", ", columns.back().name);
}

}  // namespace

std::vector<MeasureColumn> measure_columns(const std::vector<std::string>& species) {
    std::vector<MeasureColumn> columns;
    for (ColumnGroup& group : groups_of(RowObservers(), species))
        for (MeasureColumn& column : group.columns) columns.push_back(std::move(column));
    return columns;
}

// Quotes and separators of CSV would break the row.
std::string column_part(const std::string& name) {
    std::string result = name;
    for (char& c : result) {
        if (c == ',' || c == '"' || c == '\n' || c == '\r') c = '_';
    }
    return result;
}

std::string column_table_markdown() {
    std::string text = "| column | unit | what it is |\n|---|---|---|\n";
    for (const ColumnGroup& group : groups_of(RowObservers(), {"NAME"}))
        text += fmt::format("| {} | {} | {} |\n", names_of(group.columns), group.unit, group.about);
    return text;
}

}  // namespace grainreel
