// Who wants which step: the film's shots, the trajectory and the measures, merged in order of time.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/plan/field_times.hpp"
#include "engine/plan/rhythm.hpp"
#include "render/film/sampling/sampler.hpp"

namespace grainreel {

// A step at which the run stops to look.
struct Stop {
    std::int64_t step = 0;
    std::vector<int> segments;  // of the film, one a picture to be taken; empty when the film wants none
    bool trajectory = false;
    bool measures = false;
    bool moment = false;  // a later picture wants to know how the grains are now
    bool fields = false;  // a record of fields ends
    bool key = false;     // a key moment (key_moments.hpp)
};

class Agenda {
  public:
    // Steps from `first` to `last`. Shots before `first` are left out; trajectory and measures come at
    // their steps, measures at `first` and `last` too. moments: steps. clock: for what goes by periods.
    // fields: null without any.
    Agenda(std::vector<Shot> shots, const Rhythm& trajectory, const Rhythm& measures, std::int64_t first,
           std::int64_t last, std::set<std::int64_t> moments = {}, const Clock& clock = {},
           const FieldTimes* fields = nullptr);

    // The run has begun before `first`: measures come there only where they are due.
    void goes_on() { begins_ = false; }

    // Stops at these steps too.
    void want_keys(std::set<std::int64_t> steps) { keys_ = std::move(steps); }

    // The next stop, in rising order of step; the last is at `last`. Empty after it.
    std::optional<Stop> next();

    std::int64_t shots() const { return static_cast<std::int64_t>(shots_.size()); }

  private:
    std::vector<Shot> shots_;
    std::size_t shot_ = 0;
    std::set<std::int64_t> moments_, keys_;
    Rhythm trajectory_, measures_;
    Clock clock_;
    std::optional<FieldTimes> fields_;
    std::int64_t first_, last_;
    std::int64_t at_;  // steps below are done with
    bool begins_ = true;
};

}  // namespace grainreel
