// What is asked of a run that fills a folder with a film.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/run_json.hpp"
#include "engine/scene/text/assignment.hpp"
#include "render/gl/provider.hpp"

namespace grainreel {

struct FilmRequest {
    std::optional<std::filesystem::path> out;
    std::filesystem::path base = "output";  // of runs without `out`
    bool force = false;                     // a run in `out` is replaced
    bool film = true;
    bool frames = false;
    bool to_stdout = false;  // the film; the folder's name then goes to stderr
    gl::Provider gl = gl::Provider::automatic;
    std::string command;  // as typed, for run.json
    ProgramInfo program;  // likewise
};

// What is to be drawn of a finished run. Times in s, of the run; whole numbers of frames.
struct RenderRequest {
    std::filesystem::path run;  // its folder
    Assignments sets;           // other values for keys of its film
    std::optional<double> from, to, at;
    int every = 1;
};

// What is to be shown side by side.
struct CompareRequest {
    std::vector<std::filesystem::path> inputs;  // scene files and folders of runs
    Assignments sets;                           // for every scene
    std::optional<std::string> captions;        // one a panel, bars between them
};

}  // namespace grainreel
