// The folder of a hand-over whose engine has run, or still runs, becomes the folder of a run: what the dump
// says so far, with the container's motion where the run was in its frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/run_json.hpp"
#include "engine/frame.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

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

// Makes the files of a run of ours from the dump of an engine that a scene was handed over to: trajectory.nc,
// measures.csv, outflow.csv, final.csv. As the dump grows, or at once.

class ReturnedRun {
  public:
    // folder: of the run, with its scene.toml. scene, plan: those that the engine had; they must outlive
    // this. version: of our program. Throws RunError where files cannot be written.
    ReturnedRun(const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
                const HandoverFacts& facts, const std::string& version);
    ~ReturnedRun();

    // Writes what the next whole frame of the dump says; false where there is none so far. Throws UserError
    // for a dump that is not the deck's, RunError for grains that were lost.
    bool take_next();
    // final.csv, of the last frame.
    void close(RunJson& record);

    std::int64_t frames() const;
    const Frame* last() const;  // null before the first
    // The scene's walls and grains of an engine's rows, in the lab.
    static constexpr const char* kFolder = "handover";  // of deck and dump, in the run's folder

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
