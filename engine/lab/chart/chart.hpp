// The charts that `grainreel chart` can make: experiments on the methods themselves, as tables that a stopped
// chart goes on with, and pictures of them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace grainreel {

struct ChartRequest {
    std::filesystem::path folder;  // made when missing; a stopped chart there goes on
    bool quick = false;            // coarser: fewer phases, steps, seeds and settings
};

// What is being done, and the share of all that is done. Return false to stop.
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

// Counts the pieces of work and asks the watcher between them, and within long ones.
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

}  // namespace grainreel
