// What is asked of a run that fills a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "engine/files/run_json.hpp"

namespace grainreel {

// Makes the page of the run in a folder, whose other files are closed, and returns its file's name. go_on:
// told the share that is done; when it says false the page is left out, and nothing is returned. Throws when
// the page cannot be made.
using PageMaker = std::function<std::optional<std::string>(const std::filesystem::path& folder,
                                                           const std::function<bool(double)>& go_on)>;

struct RunRequest {
    std::optional<std::filesystem::path> out;  // new or empty; none: base and the scene's name, numbered
    std::filesystem::path base = "output";     // of runs without `out`
    bool force = false;                        // a run in `out` is replaced
    // s: packings that took so long or longer are kept in the user's cache folder, and found there; none: no
    std::optional<double> keep_packings;
    PageMaker page;       // none: the run leaves no page
    std::string command;  // as typed, for run.json
    ProgramInfo program;  // for run.json
};

}  // namespace grainreel
