#include "engine/run/folder/replay_progress.hpp"

#include <utility>

#include "engine/run/driver/pace.hpp"

namespace grainreel {

ReplayWatcher replay_progress(std::function<void(const Progress&)> tell) {
    return [tell = std::move(tell), watch = Stopwatch()](double done) {
        Progress progress;
        progress.stage = Progress::Stage::replaying;
        progress.done = done;
        progress.elapsed = watch.seconds();
        if (progress.elapsed < 1) return true;
        if (done > 0) progress.remaining = progress.elapsed * (1 - done) / done;
        tell(progress);
        return true;
    };
}

}  // namespace grainreel
