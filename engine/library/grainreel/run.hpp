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
    /// Where the files go, new or empty: scene.toml, trajectory.nc, measures.csv and what else the scene asks
    /// for. Empty: nothing is written.
    std::filesystem::path folder{};
    int threads = 0;   ///< As SimulationOptions::threads.
    double every = 0;  ///< s between the frames that are looked at; 0: none.
    /// Sees each of them, on the calling thread; false ends the run there in good order.
    std::function<bool(const Frame&)> look{};
};

/// How a run ended.
struct RunEnd {
    Frame frame{};          ///< The last moment.
    bool complete = false;  ///< False when `look` ended it.
};

/// Packs, runs to the end of run.duration and writes the files. The folder is one of the program's: it draws,
/// inspects, compares and resumes it. Throws Error; what was written until then stays.
RunEnd run(const Scene& scene, const RunOptions& options = {});

}  // namespace grainreel::v1
