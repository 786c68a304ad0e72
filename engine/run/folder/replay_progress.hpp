// How far a replay has come, for whoever waits for the moment.
#pragma once

#include <functional>

#include "engine/run/folder/progress.hpp"
#include "engine/run/replay/replay.hpp"

namespace grainreel {

// Tells `tell` once the replay has gone on for a second, with the time that is left. It never stops the
// replay.
ReplayWatcher replay_progress(std::function<void(const Progress&)> tell);

}  // namespace grainreel
