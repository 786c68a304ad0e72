// A run on disk brought back to one of its steps, bit by bit: from the nearest checkpoint before it the
// engine goes there once more. How often it stops on its way, and who measured in the first run, changes
// nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/file/reader.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/assignment.hpp"

namespace grainreel {

// Asked every tenth of a second or so, with the share that is done, from 0 to 1; false: stop.
using ReplayWatcher = std::function<bool(double done)>;

// The plan of a run that has checkpoints. What its grains came from need not be there any more. Throws
// UserError where there is no checkpoint.
Plan plan_of_run(const Scene& scene, const std::filesystem::path& run);

// A run with the scene that a checkpoint of it holds, as it was used; instruments and fields are left out.
// Throws UserError where the checkpoint cannot be used.
Simulation run_of_checkpoint(const std::filesystem::path& checkpoint, int threads);

// From the last of these checkpoints that is not behind `step`. A checkpoint that is damaged is passed over.
// run: named in messages. Throws UserError where none can be used, RunError when the run stopped being
// healthy or the watcher stopped it.
Simulation replayed(const std::filesystem::path& run, const std::vector<KeptCheckpoint>& kept,
                    std::int64_t step, int threads, const ReplayWatcher& watcher);

// Goes on to a later step. Throws RunError.
void replay_on(Simulation& simulation, std::int64_t step, const ReplayWatcher& watcher);

}  // namespace grainreel
