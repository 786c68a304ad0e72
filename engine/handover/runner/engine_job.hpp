// An engine that runs the deck of a folder on this machine.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/handover/guarded_process.hpp"
#include "engine/handover/runner/engine_program.hpp"

namespace grainreel {

class EngineJob {
  public:
    // restart: a restart file in the deck's folder that it goes on from; empty: from the start. Throws
    // UserError where engine or mpirun are missing, are of no use, or processors are too few.
    EngineJob(PeerEngine engine, int ranks, const std::string& deck, const std::string& restart = {});

    const EngineProgram& program() const { return program_; }
    const std::vector<std::string>& notes() const { return ranks_.notes; }
    std::string command() const;  // as typed
    // In that folder; what it prints goes to engine.txt there. Throws RunError.
    void start(const std::filesystem::path& folder);
    bool is_running();
    void stop() { process_->stop(); }
    // Once it has ended by itself: empty where all went well, else what it said, with the deck's line.
    std::string failure();

    static constexpr const char* kOutput = "engine.txt";

  private:
    PeerEngine engine_;
    std::string deck_;
    EngineProgram program_;
    RankWords ranks_;
    std::filesystem::path folder_;
    std::unique_ptr<GuardedProcess> process_;
};

}  // namespace grainreel
