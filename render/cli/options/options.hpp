// The command line: words in, options out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/bench/bench_run.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/assignment.hpp"
#include "render/cli/report/reporter.hpp"
#include "render/gl/provider.hpp"

namespace grainreel {

struct BenchRenderRequest {
    int grains = 10125;
    std::string style = "studio";  // a film's style, or "plain"
    Film film;                     // as that style has it
};

// What `render` is to draw of a finished run. Times in s, of the run; whole numbers of frames.
struct RenderRequest {
    std::filesystem::path run;  // its folder
    std::optional<double> from, to, at;
    int every = 1;
};

// What `compare` is to show side by side.
struct CompareRequest {
    std::vector<std::filesystem::path> inputs;  // scene files and folders of runs
    std::optional<std::string> captions;        // one a panel, bars between them
};

struct Options {
    enum class Verb { movie, render, compare, check, chart, bench };
    Verb verb = Verb::movie;
    std::filesystem::path scene;
    // What --set and the options that stand for a key say, --size and the like, for the scene's reader.
    Assignments sets;

    std::optional<std::filesystem::path> out;
    std::filesystem::path base = "output";  // of runs without --out; $GRAINREEL_OUTPUT when that is set
    bool force = false;
    bool film = true;
    bool frames = false;
    bool to_stdout = false;  // the film; the folder's name then goes to stderr
    RenderRequest render;
    CompareRequest compare;
    gl::Provider gl = gl::Provider::automatic;  // $GRAINREEL_GL when that is set and --gl is not
    std::string chart;                          // which, with `chart`
    bool quick = false;                         // of charts
    std::string bench;                          // which case, with `bench`
    BenchRequest bench_request;
    bool json = false;  // of bench
    BenchRenderRequest bench_render;
    ReporterOptions report;

    std::string command;  // as typed, for run.json
};

// Throws UserError for words it cannot make sense of. Empty when the words asked for help or the version,
// which then has been printed to stdout.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace grainreel
