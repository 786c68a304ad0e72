// Wall time by stage of a run.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace grainreel {

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

}  // namespace grainreel
