// The charts that `grainreel chart` can make: tables of experiments on the program's methods, and pictures of
// the tables. A chart that was stopped goes on from the rows in its tables.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "engine/base/plain_file.hpp"

namespace grainreel {

struct ChartRequest {
    std::filesystem::path folder;  // made when missing; a chart that was stopped there goes on
    bool quick = false;            // takes fewer phases, steps, seeds and settings
};

// Called with words for the present work, and the share of all work that is done. Returns false to stop.
using ChartWatcher = std::function<bool(const std::string& what, double done)>;

struct Chart {
    std::string name;
    std::string about;  // for --help
    // Writes the tables into the folder. False when the watcher stopped it.
    bool (*run)(const ChartRequest& request, const ChartWatcher& watcher);
    // Commands for gnuplot that draw the tables, to be run in the folder.
    std::string (*drawing)();
};

const std::vector<Chart>& charts();

// Counts the pieces of work, and asks the watcher between them and within long ones.
class ChartWork {
  public:
    ChartWork(const ChartWatcher& watcher, std::size_t pieces)
        : watcher_(watcher), pieces_(static_cast<double>(pieces)) {}
    bool next(const std::string& what) {
        what_ = what;
        return watcher_(what_, done_++ / pieces_);
    }
    bool goes_on() const { return watcher_(what_, (done_ - 1) / pieces_); }

  private:
    const ChartWatcher& watcher_;
    std::string what_;
    double pieces_, done_ = 0;
};

// A number as a cell: six digits.
std::string number(double value);
// The number in a cell of a row. Throws UserError where it is none.
double value_in(const std::vector<std::string>& row, std::size_t column);

// A CSV file of results, written one by one. A chart that was stopped goes on with this file.
class ResultTable {
  public:
    // Opens `path`, or makes it with this header. The first `keys` columns are the key of a row. Throws
    // UserError when the file is of another chart, RunError when it cannot be written.
    ResultTable(const std::filesystem::path& path, const std::string& header, std::size_t keys);

    // The rows so far, as cells.
    const std::vector<std::vector<std::string>>& rows() const { return rows_; }

    bool has(const std::vector<std::string>& key) const { return known_.count(join(key)) > 0; }
    // Adds a row; it is on disk when this returns.
    void add(const std::vector<std::string>& row);

  private:
    void note(const std::vector<std::string>& row);
    static std::string join(const std::vector<std::string>& cells);
    std::vector<std::vector<std::string>> rows_;
    std::set<std::string> known_;
    std::size_t keys_;
    // Stands last, because its initialiser fills the members above.
    TextFile file_;
};

}  // namespace grainreel
