// The folder of a hand-over whose engine has run, or still runs, becomes the folder of a run: what the dump
// says so far, with the container's motion where the run was in its frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace grainreel {

struct BroughtBack {
    std::int64_t frames = 0;
    double until = 0;               // s, of the last frame
    bool whole = false;             // the run has come to its end
    std::vector<std::string> news;  // a line each
};

// Writes trajectory.nc, measures.csv and final.csv beside the dump, unless they are there and newer than it.
// watcher: told the share that is done; false stops, and nothing is changed. Throws UserError where there is
// no dump, or that of another run, and RunError for grains that were lost.
BroughtBack bring_back(const std::filesystem::path& folder, const std::string& version,
                       const std::function<bool(double)>& watcher);

}  // namespace grainreel
