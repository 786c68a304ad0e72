#include "engine/run/replay/replayer.hpp"

#include <algorithm>
#include <utility>

namespace grainreel {

Replayer::Replayer(std::filesystem::path run, std::vector<KeptCheckpoint> kept, int threads)
    : run_(std::move(run)), kept_(std::move(kept)), threads_(threads) {}

bool Replayer::reaches(std::int64_t step) const {
    return !kept_.empty() && kept_.front().step <= step;
}

bool Replayer::goes_to(std::int64_t step) const {
    return reaches(step) && std::none_of(kept_.begin(), kept_.end(),
                                         [&](const KeptCheckpoint& one) { return one.step == step; });
}

bool Replayer::is_shortcut(std::int64_t from, std::int64_t to) const {
    return std::any_of(kept_.begin(), kept_.end(),
                       [&](const KeptCheckpoint& one) { return one.step > from && one.step <= to; });
}

const Simulation& Replayer::at(std::int64_t step, const ReplayWatcher& watcher) {
    const bool goes_on =
        simulation_ && simulation_->step() <= step && !is_shortcut(simulation_->step(), step);
    if (goes_on) {
        replay_on(*simulation_, step, watcher);
    } else {
        simulation_.reset();  // before the next one takes as much memory
        simulation_.emplace(replayed(run_, kept_, step, threads_, watcher));
    }
    return *simulation_;
}

}  // namespace grainreel
