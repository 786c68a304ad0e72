// Time as a count of steps. With a drive, a whole number of steps makes one period, so the phase never
// drifts.
#pragma once

#include <cmath>
#include <cstdint>

namespace grainreel {

struct Clock {
    double step = 0;                    // s, the length of one step
    std::int64_t steps_per_period = 0;  // a multiple of 8; 0 without a drive
    double initial_phase = 0;           // turns, the drive's phase at step 0

    // s since the drive started; negative while filling and settling.
    double time(std::int64_t n) const { return static_cast<double>(n) * step; }

    // Turns in [0, 1); 0 without a drive.
    double phase(std::int64_t n) const {
        if (steps_per_period == 0) return 0;
        const std::int64_t within = ((n % steps_per_period) + steps_per_period) % steps_per_period;
        const double turns =
            initial_phase + static_cast<double>(within) / static_cast<double>(steps_per_period);
        return turns - std::floor(turns);
    }

    // Periods since the drive started; 0 without a drive.
    double cycles(std::int64_t n) const {
        return steps_per_period == 0 ? 0 : static_cast<double>(n) / static_cast<double>(steps_per_period);
    }
};

}  // namespace grainreel
