// How many steps to take at a stretch, so that Ctrl-C and the progress line never wait long.
#pragma once

#include <algorithm>
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

}  // namespace grainreel
