// Brings a run on disk back to one of its steps, with the same bits. The engine computes the steps again from
// the nearest checkpoint before. The result does not depend on stops on the way, or on what was measured in
// the first run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

// Called about every tenth of a second with the share that is done, from 0 to 1. It returns false to stop.
using ReplayWatcher = std::function<bool(double done)>;

// The plan of a run that has checkpoints. The file from which its grains came need not exist any more. Throws
// UserError if there is no checkpoint.
Plan plan_of_run(const Scene& scene, const std::filesystem::path& run);

// The run at a checkpoint, with the scene that the checkpoint holds. Instruments and fields are left out.
// Throws UserError if the checkpoint cannot be used.
SimulatedBed run_of_checkpoint(const std::filesystem::path& checkpoint, int threads);

// Computes the run up to `step` from the last checkpoint of `kept` that is not after `step`. Damaged
// checkpoints are skipped. `run` is named in messages. Throws UserError if no checkpoint can be used, and
// RunError if the run is not healthy or the watcher stopped it.
SimulatedBed replayed(const std::filesystem::path& run, const std::vector<KeptCheckpoint>& kept,
                      std::int64_t step, int threads, const ReplayWatcher& watcher);

// Brings a run on disk back to one step after the other. Rising steps cost no more than the run itself did
// from the first to the last of them, because the engine goes on from one to the next.
class Replayer {
  public:
    // `kept` holds the run's checkpoints by rising step. `run` is named in messages.
    Replayer(std::filesystem::path run, std::vector<KeptCheckpoint> kept, int threads);

    // Whether there is a checkpoint at the step or before it.
    bool reaches(std::int64_t step) const;
    // Whether the step has no checkpoint of its own, so that the engine must compute steps to reach it.
    bool goes_to(std::int64_t step) const;
    // The run at a step; valid until the next call. Throws as replayed() does.
    SimulatedBed& at(std::int64_t step, const ReplayWatcher& watcher);

  private:
    // Whether a checkpoint lies between the two steps, or at the second.
    bool is_shortcut(std::int64_t from, std::int64_t to) const;

    std::filesystem::path run_;
    std::vector<KeptCheckpoint> checkpoints_;
    int threads_;
    std::optional<SimulatedBed> simulation_;
};

// The checkpoints in a run's folder that belong to this run, by rising step; the last one is whole. They have
// the run's scene, as far as it decides the future, and the step in their name. A file from elsewhere would
// lead to states that this run never had. `scene` is the scene of the run's folder. Changes on the run's way
// (`resume --accept`) are in its run.json. news: gets a line for each checkpoint that is passed over.
std::vector<KeptCheckpoint> own_checkpoints(const std::filesystem::path& run, const Scene& scene,
                                            std::vector<std::string>& news);

}  // namespace grainreel
