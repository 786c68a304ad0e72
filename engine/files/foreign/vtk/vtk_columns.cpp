#include "engine/files/foreign/vtk/vtk_columns.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::vector<double> gathered(const std::vector<double>& values, std::size_t components, std::size_t component,
                             const VtkRows& rows) {
    std::vector<double> column(rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
        const std::size_t tuple = rows.all ? i : rows.tuples[i];
        column[i] = tuple == kNoTuple ? missing : values[tuple * components + component];
    }
    return column;
}

std::string names_of(const std::vector<RawColumn>& columns) {
    std::string names;
    for (const RawColumn& column : columns) names += (names.empty() ? "" : ", ") + column.name;
    return excerpt(names, 200);
}

bool same_names(const std::vector<RawColumn>& some, const std::vector<RawColumn>& others) {
    if (some.size() != others.size()) return false;
    for (std::size_t i = 0; i < some.size(); ++i)
        if (some[i].name != others[i].name) return false;
    return true;
}

}  // namespace

std::vector<RawColumn> columns_of(std::vector<VtkArray>&& arrays, const VtkRows& rows) {
    std::vector<RawColumn> columns;
    for (VtkArray& array : arrays) {
        if (array.components == 1 && rows.all) {
            columns.push_back({array.name, std::move(array.values)});
            continue;
        }
        for (std::size_t c = 0; c < array.components; ++c)
            columns.push_back({array.components == 1 ? array.name : fmt::format("{}:{}", array.name, c),
                               gathered(array.values, array.components, c, rows)});
        array.values = {};
    }
    return columns;
}

std::vector<RawColumn> place_columns(const std::vector<double>& places, const VtkRows& rows,
                                     const char* tail) {
    std::vector<RawColumn> columns;
    for (std::size_t c = 0; c < 3; ++c)
        columns.push_back({std::string(1, "xyz"[c]) + tail, gathered(places, 3, c, rows)});
    return columns;
}

void add_rows(RawTable& table, std::vector<RawColumn>&& columns, std::size_t rows, const std::string& where) {
    if (rows == 0) {
        // The names of an empty table are known, too.
        if (table.rows == 0 && table.columns.empty()) table.columns = std::move(columns);
        return;
    }
    if (table.rows == 0) {
        table.columns = std::move(columns);
        table.rows = rows;
        return;
    }
    if (!same_names(table.columns, columns))
        throw UserError(
            fmt::format("{}: this piece has the columns {}, and those before it have {}; write all of "
                        "them with the same arrays",
                        where, names_of(columns), names_of(table.columns)));
    for (std::size_t i = 0; i < columns.size(); ++i)
        table.columns[i].values.insert(table.columns[i].values.end(), columns[i].values.begin(),
                                       columns[i].values.end());
    table.rows += rows;
}

}  // namespace grainreel
