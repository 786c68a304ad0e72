// A run on disk brought back to one of its steps, bit by bit: from the nearest checkpoint before it the
// engine goes there once more. How often it stops on its way, and who measured in the first run, changes
// nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/run/simulation.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Asked every tenth of a second or so, with the share that is done, from 0 to 1; false: stop.
using ReplayWatcher = std::function<bool(double done)>;

// The plan of a run that has checkpoints. What its grains came from need not be there any more. Throws
// UserError where there is no checkpoint.
Plan plan_of_run(const Scene& scene, const std::filesystem::path& run);

// run: its folder; scene: that of its scene.toml, of which instruments and fields are left out. plan: that of
// plan_of_run(). A checkpoint that is damaged is passed over. Throws UserError where none before `step` can
// be used, RunError when the run stopped being healthy or the watcher stopped it.
Simulation replayed(const Scene& scene, const Plan& plan, const std::filesystem::path& run, std::int64_t step,
                    int threads, const ReplayWatcher& watcher);

}  // namespace grainreel
