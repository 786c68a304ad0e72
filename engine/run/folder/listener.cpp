#include "engine/run/folder/listener.hpp"

#include <fmt/format.h>
#include <cmath>
#include <utility>

#include "engine/run/driver/pace.hpp"

namespace grainreel {

std::string duration_text(double seconds) {
    if (seconds < 9.95 && seconds != std::floor(seconds)) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

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
