#include "engine/lab/chart/chart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>

#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
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

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

std::string ResultTable::join(const std::vector<std::string>& cells) {
    return fmt::format("{}", fmt::join(cells, ","));
}

namespace {

using Rows = std::vector<std::vector<std::string>>;

// The whole rows of a table. A row that was cut short when the program was killed is left out.
Rows whole_rows(const std::filesystem::path& path) {
    std::ifstream text = read_plain(path);
    CsvRows table(text, path);
    Rows rows;
    while (table.next() && table.ended()) rows.push_back(table.words());
    return rows;
}

}  // namespace

double value_in(const std::vector<std::string>& row, std::size_t column) {
    const std::optional<double> value = number_in(row.at(column), Dialect::programs);
    if (value) return *value;
    throw UserError("a table of this chart has \"{}\" in place of a number; remove the row `{}`",
                    excerpt(row[column]), excerpt(fmt::format("{}", fmt::join(row, ","))));
}

ResultTable::ResultTable(const std::filesystem::path& path, const std::string& header, std::size_t keys)
    : keys_(keys), file_([&] {
          Rows rows = whole_rows(path);
          if (!rows.empty() && join(rows.front()) != header)
              throw UserError("{}:1: is not a table of this chart; move it away, or give another --out",
                              path.string());
          TextFile file(path);
          file.write(header + "\n");
          for (std::size_t i = 1; i < rows.size(); ++i) {
              file.write(join(rows[i]) + "\n");
              note(rows[i]);
          }
          return file;
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
