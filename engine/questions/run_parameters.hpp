// All parameters of a run in one table: those of its scene with all that the plan chose, and the program.
#pragma once

#include "engine/questions/answer.hpp"

namespace grainreel {

class StoredRun;  // engine/run/stored/stored_run.hpp

// Throws UserError where the run's folder has no scene.toml that can be read.
Answer parameters_answer(const StoredRun& run);

}  // namespace grainreel
