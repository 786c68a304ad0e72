// How fast a run goes: how many steps to take at a stretch, so that Ctrl-C and the progress line never wait
// long, and the rate to show.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace grainreel {

class Pace {
  public:
    std::int64_t steps() const { return steps_; }

    // The last stretch was `steps` long and took this many seconds.
    void took(std::int64_t steps, double seconds) {
        // At most four times more than before: one quick stretch says little about the next.
        const double most = 4.0 * static_cast<double>(steps_);
        const double wanted = seconds > 0 ? static_cast<double>(steps) * stretch / seconds : most;
        steps_ = std::clamp(static_cast<std::int64_t>(std::min(wanted, most)), std::int64_t{1}, longest);
    }

  private:
    static constexpr double stretch = 0.1;  // s, of wall time
    static constexpr std::int64_t longest = std::int64_t{1} << 40;
    std::int64_t steps_ = 8;
};

// Work a second, forgetting what is a few seconds old.
class RecentRate {
  public:
    void add(double work, double seconds) {
        const double kept = std::exp(-seconds / memory);
        work_ = kept * work_ + work;
        seconds_ = kept * seconds_ + seconds;
    }
    double value() const { return seconds_ > 0 ? work_ / seconds_ : 0; }

  private:
    static constexpr double memory = 2;  // s
    double work_ = 0, seconds_ = 0;
};

}  // namespace grainreel
