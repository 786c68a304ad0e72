// Brings a run on disk back to one of its steps, bit by bit: the engine goes there once more from the nearest
// checkpoint before. It does not matter how often it stops on its way, or what was measured in the first run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/scene_file.hpp"

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

// Brings a run on disk back to one step after the other. Rising steps cost no more than the run itself did
// from the first to the last of them, because the engine goes on from one to the next.
class Replayer {
  public:
    // kept: the run's checkpoints by rising step. run: named in messages.
    Replayer(std::filesystem::path run, std::vector<KeptCheckpoint> kept, int threads);

    // Whether there is a checkpoint of the step, or before it.
    bool reaches(std::int64_t step) const;
    // Whether the engine has a way to go to it from the checkpoint before.
    bool goes_to(std::int64_t step) const;
    // The run at that step; good until the next call. Throws as replayed() does.
    const Simulation& at(std::int64_t step, const ReplayWatcher& watcher);

  private:
    // Whether a checkpoint lies between the two, or at the second.
    bool is_shortcut(std::int64_t from, std::int64_t to) const;

    std::filesystem::path run_;
    std::vector<KeptCheckpoint> kept_;
    int threads_;
    std::optional<Simulation> simulation_;
};

// The checkpoints in a run's folder that belong to this run: they have its scene, as far as that decides the
// future, and the step that their name says. A file from elsewhere would lead to states that this run never
// had.
struct OwnCheckpoints {
    std::vector<KeptCheckpoint> kept;  // by rising step; the last one is whole
    std::vector<std::string> news;     // which checkpoints are passed over, and why
};

// scene: that of the run's folder. What was changed on the run's way (`resume --accept`) is in its run.json.
OwnCheckpoints own_checkpoints(const std::filesystem::path& run, const Scene& scene);

}  // namespace grainreel
