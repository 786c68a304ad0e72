// When a run writes its checkpoints.
#pragma once

#include <algorithm>

#include "engine/run/driver/stage_times.hpp"

namespace grainreel {

// The next one 2 s after the first, then after 4 s, 8 s, ... 30 s: what a killed run loses is never much more
// than what it has done. Those of the ring come beside them. A checkpoint of a million grains takes its time;
// so all together never cost more than a hundredth of the run.
class CheckpointPace {
  public:
    // After one that took so long to write, s.
    void saved(double cost) {
        interval_ = std::min(longest, 2 * interval_);
        cost_ = cost;
        since_ = Stopwatch();
    }
    bool due() const { return due(since_.seconds()); }
    // So long after the last one.
    bool due(double seconds) const { return seconds > std::max(interval_, share * cost_); }
    // Whether one more costs no more than it may.
    bool affordable() const { return since_.seconds() > share * cost_; }

  private:
    static constexpr double longest = 30, share = 100;
    double interval_ = 1, cost_ = 0;  // s, of wall time
    Stopwatch since_;
};

}  // namespace grainreel
