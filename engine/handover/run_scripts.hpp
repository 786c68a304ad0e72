// The shell scripts of a hand-over's folder.
#pragma once

#include <string>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

// run.sh [--continue]: starts the ranks, refuses the version whose walls ignore groups, allows root to Open
// MPI where it is root that runs it, and writes the engine's words into a file.
std::string run_script(const CarriedScene& carried);
// For `sbatch`: the same with the job's tasks.
std::string slurm_script(const CarriedScene& carried);

}  // namespace grainreel
