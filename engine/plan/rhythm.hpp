// What comes again and again: every so many steps, or of a drive that changes every so many of its periods.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/base/clock.hpp"

namespace grainreel {

struct Rhythm {
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

    double steps = 0;    // not always whole; 0: never, unless it goes by periods
    double periods = 0;  // 0: it goes by steps

    Rhythm(double every_steps, double every_periods = 0) : steps(every_steps), periods(every_periods) {}

    // The first step, not below this one (which is not negative), that is nearest to a multiple.
    std::int64_t next(std::int64_t step, const Clock& clock) const {
        if (periods > 0) {
            // A step back, lest rounding skips one.
            double count = std::max(0.0, std::floor(clock.cycles(step) / periods) - 1);
            while (clock.step_at(count * periods) < step) ++count;
            return clock.step_at(count * periods);
        }
        if (steps <= 0) return kNever;
        double count = std::floor(static_cast<double>(step) / steps);
        while (std::llround(count * steps) < step) ++count;
        return std::llround(count * steps);
    }
};

}  // namespace grainreel
