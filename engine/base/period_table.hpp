// Periods that have gone by as a function of time, for a drive whose frequency changes. Times are in any one
// unit: seconds in a DriveSchedule, steps in a Clock.
#pragma once

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

}  // namespace grainreel
