#include "engine/lab/chart/chart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/accuracy/accuracy.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/lab/chart/validation/validation.hpp"

namespace grainreel {

const std::vector<Chart>& charts() {
    static const std::vector<Chart> all = {
        {"accuracy", "error against cost: restitution, rebound, energy, a small bed", run_accuracy,
         accuracy_drawing},
        {"validation", "published experiments and laws: impacts, packings, silo, cooling gas", run_validation,
         validation_drawing},
        {"stability", "where each method fails, against theory: step, speed, stiffness, drive, round-off",
         run_stability, stability_drawing},
        {"savings", "what leaving friction, walls' motion and the like out of a scene saves", run_savings,
         savings_drawing},
    };
    return all;
}

namespace {

// The whole lines of a file. A line that was cut short when the program was killed is left out.
std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::ifstream in = read_plain(path);
    std::ostringstream whole;
    whole << in.rdbuf();
    std::string text = whole.str();
    text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
    std::vector<std::string> lines;
    std::istringstream cut(text);
    for (std::string line; std::getline(cut, line);) lines.push_back(line);
    return lines;
}

}  // namespace

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

std::string ResultTable::join(const std::vector<std::string>& cells) {
    return fmt::format("{}", fmt::join(cells, ","));
}

namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    return cells;
}

TextFile written_again(const std::filesystem::path& path, const std::vector<std::string>& lines) {
    TextFile file(path);
    for (const std::string& line : lines) file.write(line + "\n");
    return file;
}

std::vector<std::string> with_header(const std::filesystem::path& path, const std::string& header) {
    std::vector<std::string> lines = lines_of(path);
    if (lines.empty()) lines.push_back(header);
    if (lines[0] != header)
        throw UserError(fmt::format("{}:1: is not a table of this chart; move it away, or give another --out",
                                    path.string()));
    return lines;
}

}  // namespace

ResultTable::ResultTable(const std::filesystem::path& path, const std::string& header, std::size_t keys)
    : keys_(keys), file_([&] {
          const std::vector<std::string> lines = with_header(path, header);
          for (std::size_t i = 1; i < lines.size(); ++i) note(cells_of(lines[i]));
          return written_again(path, lines);
      }()) {}

void ResultTable::add(const std::vector<std::string>& row) {
    file_.write(join(row) + "\n");
    note(row);
}

void ResultTable::note(const std::vector<std::string>& row) {
    const auto keys = static_cast<std::ptrdiff_t>(std::min(keys_, row.size()));
    known_.insert(join({row.begin(), row.begin() + keys}));
    rows_.push_back(row);
}

}  // namespace grainreel
