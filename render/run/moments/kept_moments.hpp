// What pictures want of earlier steps, kept until the last picture that wants it has been taken.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace grainreel {

template <class Value>
class KeptMoments {
  public:
    // The picture at step `shot` wants these; pictures come by rising step.
    void want(std::int64_t shot, const std::vector<std::int64_t>& steps) {
        if (steps.empty()) return;
        wanted_[shot] = steps;
        for (const std::int64_t step : steps) {
            steps_.insert(step);
            last_shot_[step] = shot;
        }
    }
    // At which something has to be kept.
    const std::set<std::int64_t>& steps() const { return steps_; }
    bool wants(std::int64_t step) const { return steps_.count(step) > 0; }
    void keep(std::int64_t step, Value value) { kept_[step] = std::move(value); }

    // Those that the picture wants, as they were given; none for one that wants nothing.
    std::vector<std::int64_t> of(std::int64_t shot) const {
        const auto found = wanted_.find(shot);
        return found == wanted_.end() ? std::vector<std::int64_t>{} : found->second;
    }
    // Null when it was not kept.
    const Value* at(std::int64_t step) const {
        const auto found = kept_.find(step);
        return found == kept_.end() ? nullptr : &found->second;
    }
    // The picture is taken: forgets what no later one wants.
    void done_with(std::int64_t shot) {
        for (const std::int64_t step : of(shot))
            if (last_shot_.at(step) == shot) kept_.erase(step);
        wanted_.erase(shot);
    }

  private:
    std::map<std::int64_t, std::vector<std::int64_t>> wanted_;
    std::set<std::int64_t> steps_;
    std::map<std::int64_t, std::int64_t> last_shot_;  // that wants a step
    std::map<std::int64_t, Value> kept_;
};

}  // namespace grainreel
