// The checkpoints of a run's folder that are of this run: with its scene, so far as that decides the future,
// and at the step that they are named by. A file from elsewhere leads nowhere that this run has been.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct OwnCheckpoints {
    std::vector<KeptCheckpoint> kept;  // by rising step; the last one is whole
    std::vector<std::string> news;     // of those that are passed over: which, and why
};

// scene: that of the run's folder. What was changed on the run's way (`resume --accept`) is in its run.json.
OwnCheckpoints own_checkpoints(const std::filesystem::path& run, const Scene& scene);

}  // namespace grainreel
