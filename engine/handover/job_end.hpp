// How the job of a hand-over ended, as the files say that it left in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "engine/handover/handover_folder.hpp"

namespace grainreel {

// run.sh writes the exit status of mpirun into this file once it has ended.
inline constexpr const char* status_name = "job.status";
std::string log_name(PeerEngine engine);     // "log.lammps", which has the commands before an error
std::string output_name(PeerEngine engine);  // "out.lammps"

struct JobEnd {
    bool ended = false;   // known to have ended; a job whose run.sh was killed leaves no word
    std::string failure;  // what went wrong, one line; empty where nothing is known to have
};
JobEnd job_end(const std::filesystem::path& folder, const HandoverFacts& facts);

// "LAMMPS has come to 0.1 s of 0.3 s; what there is is shown", with why it ended if that is known. until,
// wanted: s.
std::string came_so_far(const std::filesystem::path& folder, const HandoverFacts& facts, double until,
                        double wanted);

}  // namespace grainreel
