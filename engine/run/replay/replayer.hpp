// A run on disk brought back to one step after the other. Steps that rise cost no more than the run itself
// did from the first to the last of them: the engine goes on from one to the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/run/simulation/simulation.hpp"

namespace grainreel {

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

}  // namespace grainreel
