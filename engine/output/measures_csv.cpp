#include "engine/output/measures_csv.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"

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
    std::ifstream file(path);
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

void MeasuresWriter::write(const Measures& measures) {
    GRAINREEL_CHECK(measures.names() == columns_);
    file_.write(fmt::format("{}\n", fmt::join(measures.values(), ",")));
    ++rows_;
}

}  // namespace grainreel
