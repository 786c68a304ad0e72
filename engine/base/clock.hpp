// Time as a count of steps. With a drive, a whole number of steps makes one period, so the phase never
// drifts. Where the drive's frequency changes, a table says after how many periods each step comes.
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/base/period_table.hpp"

namespace grainreel {

struct Clock {
    double step = 0;                    // s, the length of one step
    std::int64_t steps_per_period = 0;  // a multiple of 8; 0 without a drive; at first where it changes
    double initial_phase = 0;           // turns, the drive's phase at step 0
    PeriodTable changes = {};           // in steps; empty for one frequency throughout

    // s since the drive started; negative while filling and settling.
    double time(std::int64_t n) const { return static_cast<double>(n) * step; }

    // Turns in [0, 1); 0 without a drive.
    double phase(std::int64_t n) const {
        if (steps_per_period == 0) return 0;
        if (changing_at(n)) {
            const PeriodStretch& in = changes.stretches()[changes.index_at(static_cast<double>(n))];
            const double begins = std::floor(in.start);
            const double turns =
                initial_phase + in.turns_after(static_cast<double>(n) - begins, begins - in.start);
            return turns - std::floor(turns);
        }
        const std::int64_t within = ((n % steps_per_period) + steps_per_period) % steps_per_period;
        const double turns =
            initial_phase + static_cast<double>(within) / static_cast<double>(steps_per_period);
        return turns - std::floor(turns);
    }

    // Periods since the drive started; 0 without a drive.
    double cycles(std::int64_t n) const {
        if (steps_per_period == 0) return 0;
        if (changing_at(n)) return changes.cycles(static_cast<double>(n));
        return static_cast<double>(n) / static_cast<double>(steps_per_period);
    }

    // With a drive: the step nearest to the moment when so many periods have gone by.
    std::int64_t step_at(double cycles) const {
        if (!changes.empty() && cycles >= 0) return std::llround(changes.time(cycles));
        return std::llround(cycles * static_cast<double>(steps_per_period));
    }

    // With a drive: steps of a period that begins about then, not always whole.
    double period_at(std::int64_t n) const {
        if (!changing_at(n)) return static_cast<double>(steps_per_period);
        const double begins = changes.cycles(static_cast<double>(n));
        return changes.time(begins + 1) - static_cast<double>(n);
    }

  private:
    bool changing_at(std::int64_t n) const { return !changes.empty() && n >= 0; }
};

}  // namespace grainreel
