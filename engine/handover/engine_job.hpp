// The programs of other engines on this machine.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"
#include "engine/handover/guarded_process.hpp"

namespace grainreel {

struct EngineProgram {
    std::filesystem::path path;
    std::string version;  // "29 Sep 2021 - Update 2", "3.8.0"
};

// A program by its name among the folders of PATH; empty where none has it.
std::filesystem::path program_named(const std::string& name);

// `lmp` or `liggghts`. Throws UserError where it is not installed, and names Debian's package; where it does
// not start; and for LAMMPS of 28 Mar 2023, whose walls act on all grains whatever their group.
EngineProgram find_engine(PeerEngine engine);
// The version among the first lines that the engine says of itself; empty where there is none.
std::string version_in(PeerEngine engine, const std::string& text);
// Throws UserError for versions whose results would be wrong.
void check_version(PeerEngine engine, const std::string& version);

// The words that start so many ranks of it with a deck. Throws UserError where there is no mpirun, and where
// this process may use fewer processors than ranks.
struct RankWords {
    std::vector<std::string> words;
    std::vector<std::string> notes;  // what the user should know, a line each
};
RankWords rank_words(PeerEngine engine, const EngineProgram& program, const std::string& deck, int ranks);

// What an engine said when it failed, with the deck's line at which it did.

// "in.lammps:7: ERROR: Unrecognized pair style 'x' (at `pair_style x`)". output: the file of what it printed,
// its commands among it (-echo both). Empty where that has no error; a file that cannot be read has none.
std::string engine_error(const std::filesystem::path& output, const std::filesystem::path& deck);

// An engine that runs the deck of a folder on this machine.

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
