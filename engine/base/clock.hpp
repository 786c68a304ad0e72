// Periods that have gone by as a function of time, for a drive whose frequency changes. Times are in any one
// unit: seconds in a DriveSchedule, steps in a Clock.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace grainreel {

// A stretch of time at one frequency, or in which the frequency goes from one to another. It begins with a
// whole period.
struct PeriodStretch {
    double start = 0;
    double cycles = 0;  // periods until its start, a whole number
    double period = 0;  // at its start
    // The change: f(u) = f0 + (f1 - f0) s(u), with u from 0 to 1 and s of smooth_step.hpp.
    double period_after = 0;
    double length = std::numeric_limits<double>::infinity();  // infinite: nothing changes

    bool changes() const { return length < std::numeric_limits<double>::infinity(); }
    // Periods since its start, at a time since its start: the integral of f.
    double cycles_after(double time) const;
    // Where nothing changes: how long ago the last whole period began, in [0, period). The time since the
    // start is `whole`, of which no digit is lost however large it is, and a small part more.
    double into_period(double whole, double part) const;
    // Periods since the start less whole ones, in [0, 1); as above.
    double turns_after(double whole, double part) const;
    // The time since its start after so many periods.
    double time_after(double cycles) const;
};

// How long a change takes so that exactly so many periods go by in it.
double length_of_change(double cycles, double period, double period_after);

class PeriodTable {
  public:
    bool empty() const { return stretches_.empty(); }
    void add(const PeriodStretch& stretch) { stretches_.push_back(stretch); }
    const std::vector<PeriodStretch>& stretches() const { return stretches_; }

    // Times below that of the first stretch, and cycles below its own, count as part of the first.
    std::size_t index_at(double time) const;
    std::size_t index_at_cycles(double cycles) const;
    double cycles(double time) const;
    double time(double cycles) const;

  private:
    std::vector<PeriodStretch> stretches_;  // by rising start
};

// Time as a count of steps. With a drive, a whole number of steps makes one period, so the phase never
// drifts. Where the drive's frequency changes, a table says after how many periods each step comes.

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
