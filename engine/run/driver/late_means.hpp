// Means of the measures over the last periods of a run: a single row of a shaken bed says where in its period
// it was taken.
#pragma once

#include <deque>
#include <string>

#include "engine/base/clock.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {

class LateMeans {
  public:
    // Over the last ten periods of the drive, or as many whole ones as there are; without a drive over the
    // last tenth of the run's duration (s).
    LateMeans(const Clock& clock, double duration) : clock_(clock), duration_(duration) {}

    // Rows come one after the other, with their step.
    void add(const Measures& row);
    // The mean of all rows that have a value. NaN where none has.
    Measures means() const;
    // What they are means of: "the last 10 periods"; "the last row" where not even one period has passed.
    std::string over() const;

  private:
    std::int64_t step_of(const Measures& row) const { return static_cast<std::int64_t>(row.at("step")); }
    int periods() const;                      // whole ones, with a drive
    bool is_late(const Measures& row) const;  // as seen from the last row

    Clock clock_;
    double duration_;
    std::deque<Measures> rows_;
};

}  // namespace grainreel
