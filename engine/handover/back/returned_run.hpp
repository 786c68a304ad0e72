// Makes the files of a run of ours from the dump of an engine that a scene was handed over to: trajectory.nc,
// measures.csv, outflow.csv, final.csv. As the dump grows, or at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/files/run_json.hpp"
#include "engine/frame.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

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
    void close(RunRecord& record);

    std::int64_t frames() const;
    const Frame* last() const;  // null before the first
    // The scene's walls and grains of an engine's rows, in the lab.
    static constexpr const char* kFolder = "handover";  // of deck and dump, in the run's folder

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
