// Reads and writes measures.csv. Its columns come from engine/measure; this file knows only how rows stand as
// text. If that changes, the reader, the writer and cut_before() must change together.
#include "engine/files/measures_csv.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/counted.hpp"
#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {
namespace {

// Reads the numbers of a row. Returns what is wrong with it, or nothing.
std::string fault_of(const std::vector<CsvCell>& cells, const std::vector<std::string>& columns,
                     std::vector<double>& row) {
    row.clear();
    if (cells.size() != columns.size())
        return fmt::format("has {}, but there are {} columns", counted(cells.size(), "number"),
                           columns.size());
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const std::optional<double> value = number_in(cells[k].text, Dialect::programs);
        if (!value)
            return fmt::format("its {} is no number but \"{}\"", excerpt(columns[k]), excerpt(cells[k].text));
        row.push_back(*value);
    }
    return "";
}

}  // namespace

MeasuresFile read_measures_file(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    CsvRows rows(file, path);
    MeasuresFile result;
    if (!rows.next()) return result;
    const std::vector<std::string> columns = rows.words();
    const auto table = std::make_shared<MeasureTable>(columns);
    result.table = table;
    std::vector<double> row;
    while (rows.next() && rows.ended()) {
        if (const std::string fault = fault_of(rows.cells(), columns, row); !fault.empty()) {
            result.fault = fmt::format("{}:{}: {}", path.string(), rows.line(), fault);
            break;
        }
        table->add(row);
    }
    return result;
}

std::shared_ptr<const MeasureTable> read_measures(const std::filesystem::path& path) {
    return read_measures_file(path).table;
}

MeasuresWriter::MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns)
    : file_(path), columns_(std::move(columns)) {
    file_.write(fmt::format("{}\n", fmt::join(columns_, ",")));
}

MeasuresWriter::MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns,
                               std::int64_t step)
    : MeasuresWriter(path, columns, cut_before(path, columns, step)) {}

MeasuresWriter::MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns,
                               const Cut& cut)
    : file_(path, cut.bytes), columns_(std::move(columns)), rows_(cut.rows) {}

// How much of the file stays: its header and all whole rows before that step.
MeasuresWriter::Cut MeasuresWriter::cut_before(const std::filesystem::path& path,
                                               const std::vector<std::string>& columns, std::int64_t step) {
    std::ifstream file = read_plain(path);
    CsvRows rows(file, path);
    if (!rows.next() || !rows.ended() || rows.words() != columns)
        throw UserError("{}: is missing, or has other columns than this run", path.string());
    const std::size_t place = place_in(columns, "step").value();
    Cut cut{rows.bytes(), 0};
    while (rows.next() && rows.ended() && rows.cells().size() == columns.size()) {
        const double step_of_row = number_in(rows.cells()[place].text).value_or(0);
        if (step_of_row >= static_cast<double>(step)) break;
        cut.bytes = rows.bytes();
        ++cut.rows;
    }
    return cut;
}

void MeasuresWriter::write(const Measures& measures) {
    GRAINREEL_CHECK(measures.names() == columns_);
    std::vector<double> values = measures.values();
    for (double& value : values)
        if (std::isnan(value)) value = kUnknown;  // a NaN with a sign would be written as -nan
    file_.write(fmt::format("{}\n", fmt::join(values, ",")));
    ++rows_;
}

}  // namespace grainreel
