/// @file
/// A scene from its beginning to its end in one call, with all files of a run.
#pragma once

#include <filesystem>
#include <functional>

#include "grainreel/frame.hpp"
#include "grainreel/scene.hpp"

namespace grainreel::v1 {

/// How a scene is run in one call.
struct RunOptions {
    /// Where the files go, a folder that is new or empty: scene.toml, trajectory.nc, measures.csv and what
    /// else the scene asks for. An older run is never replaced. With an empty name nothing is written.
    std::filesystem::path folder{};
    int threads = 0;   ///< As SimulationOptions::threads, up to 1024.
    double every = 0;  ///< s between the frames that `look` gets; 0: none.
    /// Is called with each of these frames, on the calling thread. If it returns false, the run ends there,
    /// and its files are completed.
    std::function<bool(const Frame&)> look{};
};

/// How a run ended.
struct RunEnd {
    Frame frame{};          ///< The last moment.
    bool complete = false;  ///< False when `look` ended it.
};

/// Packs the grains, runs to the end of run.duration and writes the files. The folder is like one that the
/// program makes: the program can draw, inspect, compare and resume it. Throws Error; what was written until
/// then stays.
RunEnd run(const Scene& scene, const RunOptions& options = {});

}  // namespace grainreel::v1
