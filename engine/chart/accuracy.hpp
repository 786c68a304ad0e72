// `grainreel chart accuracy`: error against cost, one factor at a time. Two tables, each row a result:
// contacts.csv (single contacts) and bed.csv (the small bed, every setting with every seed).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace grainreel {

struct AccuracyRequest {
    std::filesystem::path folder;  // made when missing; a stopped chart there goes on
    bool quick = false;            // fewer phases, steps, seeds and settings
};

// What is being done, and the share of all that is done. Return false to stop.
using ChartWatcher = std::function<bool(const std::string& what, double done)>;

// False when the watcher stopped it.
bool run_accuracy(const AccuracyRequest& request, const ChartWatcher& watcher);

// Commands for gnuplot that draw the tables, to be run in the folder; what they write.
std::string accuracy_drawing();

}  // namespace grainreel
