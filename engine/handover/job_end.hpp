// How the job of a hand-over ended, according to the files that it left in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "engine/handover/handover_folder.hpp"

namespace grainreel {

// run.sh writes this file: "running", and in its place the exit status of mpirun once that has ended. The
// second line names the job: "job NODE PROCESS TIME start", or "continue" at the end if it went on from a
// restart file.
inline constexpr const char* status_name = "job.status";
std::string log_name(
    PeerEngine engine);  // "log.lammps", the engine's own log, which also shows the command that failed
std::string output_name(PeerEngine engine);  // "out.lammps"

struct JobEnd {
    bool begun = false;    // known to have begun
    bool ended = false;    // known to have ended; stays false if run.sh itself was killed
    std::string job;       // its name, which no other job has; empty if that is not known
    bool goes_on = false;  // whether it went on from a restart file
    std::string failure;   // what went wrong, one line; empty if no failure is known
};
JobEnd job_end(const std::filesystem::path& folder, const HandoverFacts& facts);

// "LAMMPS has come to 0.1 s of 0.3 s; what there is is shown", with why it ended if that is known. until:
// s, simulated so far. wanted: s, simulated in all.
std::string came_so_far(const std::filesystem::path& folder, const HandoverFacts& facts, double until,
                        double wanted);

}  // namespace grainreel
