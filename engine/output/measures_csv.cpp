#include "engine/output/measures_csv.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/no_value.hpp"

namespace grainreel {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

}  // namespace

std::shared_ptr<const MeasureTable> read_measures(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    std::string line;
    if (!std::getline(file, line)) return nullptr;
    const auto table = std::make_shared<MeasureTable>(cells_of(line));
    while (std::getline(file, line) && !file.eof()) {  // a last line without its end was cut off
        std::vector<double> row;
        for (const std::string& cell : cells_of(line)) row.push_back(std::strtod(cell.c_str(), nullptr));
        if (row.size() != table->columns().size()) break;
        table->add(row);
    }
    return table;
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

// How much of the file stays: its header, and whole rows up to the first that is not before that step.
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
        if (std::isnan(value)) value = kNoValue;  // its sign would show as -nan
    file_.write(fmt::format("{}\n", fmt::join(values, ",")));
    ++rows_;
}

}  // namespace grainreel
