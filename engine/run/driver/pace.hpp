// The pace of a run in wall time: how many steps it takes between two looks at the user's signals, the times
// of its stages, and when checkpoints are due.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/mathematics.hpp"

namespace grainreel {

// Finds how many steps to take at a stretch, so that Ctrl-C and the progress line never wait long.
class Pace {
  public:
    std::int64_t steps() const { return steps_; }

    // Notes that the last stretch had `steps` steps and took `seconds` seconds.
    void took(std::int64_t steps, double seconds) {
        // At most four times as many as before: one quick stretch says little about the next.
        const double most = 4.0 * static_cast<double>(steps_);
        const double wanted = seconds > 0 ? static_cast<double>(steps) * stretch / seconds : most;
        steps_ = std::clamp(static_cast<std::int64_t>(std::min(wanted, most)), std::int64_t{1}, longest);
    }

  private:
    static constexpr double stretch = 0.1;  // s, wanted wall time of a stretch
    static constexpr std::int64_t longest = std::int64_t{1} << 40;
    std::int64_t steps_ = 8;
};

// Work per second. Work that is a few seconds old is forgotten.
class RecentRate {
  public:
    void add(double work, double seconds) {
        const double kept = math::exp(-seconds / memory);
        work_ = kept * work_ + work;
        seconds_ = kept * seconds_ + seconds;
    }
    double value() const { return seconds_ > 0 ? work_ / seconds_ : 0; }

  private:
    static constexpr double memory = 2;  // s, after which old work counts only 1/e
    double work_ = 0, seconds_ = 0;
};

// Wall time by stage of a run.
class Stopwatch {
  public:
    double seconds() const { return std::chrono::duration<double>(Watch::now() - start_).count(); }

  private:
    using Watch = std::chrono::steady_clock;
    Watch::time_point start_ = Watch::now();
};

class StageTimes {
  public:
    void add(const std::string& stage, double seconds) {
        for (auto& [name, sum] : sums_) {
            if (name == stage) {
                sum += seconds;
                return;
            }
        }
        sums_.emplace_back(stage, seconds);
    }

    // Adds the time that the scope of the returned object takes, also when an exception ends it.
    auto during(std::string stage) {
        struct Timer {
            StageTimes& times;
            std::string stage;
            Stopwatch watch{};
            ~Timer() { times.add(stage, watch.seconds()); }
        };
        return Timer{*this, std::move(stage)};
    }

    double of(const std::string& stage) const {
        for (const auto& [name, sum] : sums_) {
            if (name == stage) return sum;
        }
        return 0;
    }

    const std::vector<std::pair<std::string, double>>& all() const { return sums_; }

  private:
    std::vector<std::pair<std::string, double>> sums_;  // in order of first use
};

// When a run writes its checkpoints. The second one comes 2 s after the first, the next after 4 s, 8 s, ...
// 30 s, so that a killed run never loses much more than it has done. Checkpoints of the ring come in
// addition. Because a checkpoint of a million grains takes long, the next one waits at least a hundred times
// as long as the last one took. Those at the start and at the end of a run do not wait.
class CheckpointPace {
  public:
    // Call this after a checkpoint that took `cost` seconds to write.
    void saved(double cost) {
        interval_ = std::min(longest, 2 * interval_);
        cost_ = cost;
        since_ = Stopwatch();
    }
    bool due() const { return due(since_.seconds()); }
    // Whether a checkpoint is due `seconds` after the last one.
    bool due(double seconds) const { return seconds > std::max(interval_, share * cost_); }
    // Whether one more checkpoint stays within the allowed share of time.
    bool affordable() const { return since_.seconds() > share * cost_; }

  private:
    static constexpr double longest = 30, share = 100;
    double interval_ = 1, cost_ = 0;  // s, of wall time
    Stopwatch since_;
};

}  // namespace grainreel
