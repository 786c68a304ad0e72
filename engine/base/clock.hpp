// Clock: time as a count of steps. PeriodTable: how many periods of the drive have gone by at a time, where
// its frequency changes. Times in a table have one unit: seconds in a DriveSchedule, steps in a Clock.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace grainreel {

// A stretch of time in which the frequency is constant or goes from one value to another. At its start a
// period begins.
struct PeriodStretch {
    double start = 0;
    double cycles = 0;  // number of periods before its start, a whole number
    double period = 0;  // at its start
    // The frequency changes as f(u) = f0 + (f1 - f0) s(u), with u from 0 to 1 and s of smooth_step.
    double period_after = 0;
    double length =
        std::numeric_limits<double>::infinity();  // how long the change lasts; infinite without one

    bool changes() const { return length < std::numeric_limits<double>::infinity(); }
    // Number of periods in the first `time` of the stretch: the integral of f.
    double cycles_after(double time) const;
    // For a stretch without a change: the time since the present period began, in [0, period). `whole + part`
    // is the time since the stretch began. They are given apart so that a large `whole` loses no digits to a
    // small `part`.
    double into_period(double whole, double part) const;
    // The part of the present period that has gone by, in [0, 1). The time is given as above.
    double turns_after(double whole, double part) const;
    // The time from the start of the stretch until `cycles` periods have gone by.
    double time_after(double cycles) const;
};

// How long a change of frequency must last so that exactly `cycles` periods go by in it.
double length_of_change(double cycles, double period, double period_after);

class PeriodTable {
  public:
    bool empty() const { return stretches_.empty(); }
    void add(const PeriodStretch& stretch) { stretches_.push_back(stretch); }
    const std::vector<PeriodStretch>& stretches() const { return stretches_; }

    // The stretch in which a time lies, given as a time or as the number of periods gone by. What lies before
    // the first stretch counts as part of it.
    std::size_t index_at(double time) const;
    std::size_t index_at_cycles(double cycles) const;
    double cycles(double time) const;
    double time(double cycles) const;

  private:
    std::vector<PeriodStretch> stretches_;  // by rising start
};

// Time as a count of steps. With a drive, one period is a whole number of steps, so that the phase never
// drifts. Where the drive's frequency changes, a table tells the number of periods before each step.
struct Clock {
    double step = 0;                    // s, the length of one step
    std::int64_t steps_per_period = 0;  // a multiple of 8; for the drive's first frequency; 0 without a drive
    double initial_phase = 0;           // turns, the drive's phase at step 0
    PeriodTable changes = {};           // times in steps; empty if the frequency stays the same

    // s since the drive started; negative while filling and settling.
    double time(std::int64_t n) const { return static_cast<double>(n) * step; }

    // The drive's phase in turns, in [0, 1); 0 without a drive.
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

    // Number of periods since the drive started; 0 without a drive.
    double cycles(std::int64_t n) const {
        if (steps_per_period == 0) return 0;
        if (changing_at(n)) return changes.cycles(static_cast<double>(n));
        return static_cast<double>(n) / static_cast<double>(steps_per_period);
    }

    // The step nearest to the time when `cycles` periods have gone by. There must be a drive.
    std::int64_t step_at(double cycles) const {
        if (!changes.empty() && cycles >= 0) return std::llround(changes.time(cycles));
        return std::llround(cycles * static_cast<double>(steps_per_period));
    }

    // The length in steps of the period that begins at step n, not always a whole number. There must be a
    // drive.
    double period_at(std::int64_t n) const {
        if (!changing_at(n)) return static_cast<double>(steps_per_period);
        const double begins = changes.cycles(static_cast<double>(n));
        return changes.time(begins + 1) - static_cast<double>(n);
    }

  private:
    bool changing_at(std::int64_t n) const { return !changes.empty() && n >= 0; }
};

}  // namespace grainreel
