// Runs another engine on this machine: finds its program and version, starts it with a deck, and explains its
// error messages. Also says how a job ended that somebody else ran by the run.sh of its folder. The process
// itself is in guarded_process.hpp.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"
#include "engine/handover/guarded_process.hpp"
#include "engine/handover/handover_folder.hpp"

namespace grainreel {

struct EngineProgram {
    std::filesystem::path path;
    std::string version;  // "29 Sep 2021 - Update 2", "3.8.0"
};

// The path of a program by its name in the folders of PATH; empty where there is none.
std::filesystem::path program_named(const std::string& name);

// Finds `lmp` or `liggghts`. Throws UserError where it is not installed (and names Debian's package), where
// it does not start, and for LAMMPS of 28 Mar 2023, whose walls act on all grains whatever their group.
EngineProgram find_engine(PeerEngine engine);
// The version in the first lines that the engine prints; empty where there is none.
std::string version_in(PeerEngine engine, const std::string& text);
// Throws UserError for versions whose results would be wrong.
void check_version(PeerEngine engine, const std::string& version);

// The command that starts so many ranks of the engine with a deck. goes_on: of a run that `resume` continues,
// for messages. Throws UserError where there is no mpirun, and where this process may use fewer processors
// than ranks.
struct RankWords {
    std::vector<std::string> words;
    std::vector<std::string> notes;  // what the user should know, a line for each
};
RankWords rank_words(PeerEngine engine, const EngineProgram& program, const std::string& deck, int ranks,
                     bool goes_on = false);

// The error message of an engine with the line of the deck: "in.lammps:7: ERROR: Unrecognized pair style 'x'
// (at `pair_style x`)". output: the file with all that it printed, including its commands (-echo both). Empty
// where there is no error or the file cannot be read.
std::string engine_error(const std::filesystem::path& output, const std::filesystem::path& deck);

// An engine that runs the deck in a folder.
class PeerProcess {
  public:
    // restart: a file in the deck's folder from which the engine continues; empty: it starts from the
    // beginning. Throws UserError where engine or mpirun are missing or cannot be used, or there are too few
    // processors.
    PeerProcess(PeerEngine engine, int ranks, const std::string& deck, const std::string& restart = {});

    const EngineProgram& program() const { return program_; }
    const std::vector<std::string>& notes() const { return ranks_.notes; }
    std::string command() const;  // as one would type it
    // Starts the engine in that folder. What it prints goes to engine.txt there. Throws RunError.
    void start(const std::filesystem::path& folder);
    bool is_running();
    void stop() { process_->stop(); }
    // Called when it has ended by itself. Empty where all went well, else its error message with the deck's
    // line.
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

// From here on: the job of a hand-over, which run.sh starts. What is known of it are the files in its folder.

// run.sh writes this file: first "running", and in the end its exit status. The second line names the job:
// "job NODE PROCESS TIME start", or "continue" at the end if it went on from a restart file.
inline constexpr const char* status_name = "job.status";
// "log.lammps", the engine's own log, which also shows the command that failed.
std::string log_name(PeerEngine engine);
std::string output_name(PeerEngine engine);  // "out.lammps"

struct JobEnd {
    bool begun = false;    // known to have begun
    bool ended = false;    // known to have ended; stays false if run.sh itself was killed
    std::string job;       // its name, which no other job has; empty if that is not known
    bool goes_on = false;  // whether it went on from a restart file
    std::string failure;   // what went wrong, one line; empty if no failure is known
};
JobEnd job_end(const std::filesystem::path& folder, const HandoverFacts& facts);

// The step of the newest restart file in the folder of a deck; none where there is no restart file.
std::optional<std::int64_t> newest_restart(const std::filesystem::path& folder, PeerEngine engine);

// When a signal asks LIGGGHTS to end, it writes a restart file under another name. If the output says that
// this file is whole, the function gives it the name of the others, so that the run goes on from there.
// Otherwise it removes the file.
void take_forced_restarts(const std::filesystem::path& folder, const std::filesystem::path& output);

// "LAMMPS has come to 0.1 s of 0.3 s; what there is is shown", with why it ended if that is known. until:
// s, simulated so far. wanted: s, simulated in all.
std::string came_so_far(const std::filesystem::path& folder, const HandoverFacts& facts, double until,
                        double wanted);

}  // namespace grainreel
