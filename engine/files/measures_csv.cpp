// Reads and writes measures.csv. Its columns come from engine/measure; this file knows only how rows stand as
// text. If that changes, the reader, the writer and cut_before() must change together.
#include "engine/files/measures_csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

// The number in a cell. None where the cell is empty or holds anything besides a number.
std::optional<double> number_of(const std::string& cell) {
    double value = 0;
    const char* const end = cell.data() + cell.size();
    const auto read = std::from_chars(cell.data(), end, value);
    if (read.ptr != end || cell.empty()) return std::nullopt;
    // A number beyond the range of a double is read as 0 or infinity.
    if (read.ec == std::errc::result_out_of_range) return std::strtod(cell.c_str(), nullptr);
    return read.ec == std::errc() ? std::optional(value) : std::nullopt;
}

// Reads the numbers of a row. Returns what is wrong with it, or nothing.
std::string fault_of(const std::vector<std::string>& cells, const std::vector<std::string>& columns,
                     std::vector<double>& row) {
    row.clear();
    if (cells.size() != columns.size())
        return fmt::format("has {}, but there are {} columns", counted(cells.size(), "number"),
                           columns.size());
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const std::optional<double> value = number_of(cells[k]);
        if (!value)
            return fmt::format("its {} is no number but \"{}\"", excerpt(columns[k]), excerpt(cells[k]));
        row.push_back(*value);
    }
    return "";
}

// Removes the carriage return that ends each line of a file from Windows.
void drop_return(std::string& line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
}

}  // namespace

MeasuresFile read_measures_file(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    std::string line;
    MeasuresFile result;
    if (!std::getline(file, line)) return result;
    drop_byte_order_mark(line);
    drop_return(line);
    const std::vector<std::string> columns = cells_of(line);
    if (columns.empty()) return result;
    const auto table = std::make_shared<MeasureTable>(columns);
    result.table = table;
    std::vector<double> row;
    for (std::size_t number = 2; std::getline(file, line) && !file.eof(); ++number) {
        drop_return(line);
        if (const std::string fault = fault_of(cells_of(line), columns, row); !fault.empty()) {
            result.fault = fmt::format("{}:{}: {}", path.string(), number, fault);
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
    std::string line;
    if (!std::getline(file, line) || file.eof() || cells_of(line) != columns)
        throw UserError(fmt::format("{}: is missing, or has other columns than this run", path.string()));
    const auto place = std::find(columns.begin(), columns.end(), "step") - columns.begin();
    Cut cut{line.size() + 1, 0};
    while (std::getline(file, line) && !file.eof()) {
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() != columns.size()) break;
        if (std::strtod(cells[static_cast<std::size_t>(place)].c_str(), nullptr) >= static_cast<double>(step))
            break;
        cut.bytes += line.size() + 1;
        ++cut.rows;
    }
    return cut;
}

void MeasuresWriter::write(const Measures& measures) {
    GRAINREEL_CHECK(measures.names() == columns_);
    std::vector<double> values = measures.values();
    for (double& value : values)
        if (std::isnan(value)) value = kNoValue;  // a NaN with a sign would be written as -nan
    file_.write(fmt::format("{}\n", fmt::join(values, ",")));
    ++rows_;
}

}  // namespace grainreel
