// The steps at which a run stops, and what for: frames that are handed out, rows of files, and key moments
// for the run's page. All are merged in order of time.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/plan/times.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// A step at which the run stops to look.
struct Stop {
    std::int64_t step = 0;
    bool frame = false;  // a frame is handed out
    bool trajectory = false;
    bool measures = false;
    bool moment = false;  // a frame that is handed out later wants to know how the grains are now
    bool fields = false;  // a record of fields ends
    bool key = false;     // a key moment (key_steps())
};

class Agenda {
  public:
    // Steps from `first` to `last`. frames: steps, rising; those before `first` are left out. Trajectory and
    // measures come at their steps, measures at `first` and `last` too. moments: steps. clock: for what goes
    // by periods. fields: null without any.
    Agenda(std::vector<std::int64_t> frames, const Rhythm& trajectory, const Rhythm& measures,
           std::int64_t first, std::int64_t last, std::set<std::int64_t> moments = {},
           const Clock& clock = {}, const FieldTimes* fields = nullptr);

    // The run has begun before `first`: measures come there only where they are due.
    void goes_on() { begins_ = false; }

    // Stops at these steps too.
    void want_keys(std::set<std::int64_t> steps) { keys_ = std::move(steps); }

    // The next stop, in rising order of step; the last is at `last`. Empty after it.
    std::optional<Stop> next();

  private:
    std::vector<std::int64_t> frames_;
    std::size_t frame_ = 0;  // the next of them
    std::set<std::int64_t> moments_, keys_;
    Rhythm trajectory_, measures_;
    Clock clock_;
    std::optional<FieldTimes> fields_;
    std::int64_t first_, last_;
    std::int64_t at_;  // steps below are done with
    bool begins_ = true;
};

// Key moments of a run are those of which it keeps all contacts with their forces (key_moments.nc,
// key_contacts.nc), for its page: the start, the end and the two periods before it, times that somebody
// names, and some in between. Returns their steps, from `first` to the plan's last. named: s of simulated
// time, such as those at which captions of a film begin. The more grains, the fewer, so that both files
// together take 40 MB or so; none where a single moment takes more.
std::set<std::int64_t> key_steps(const Scene& scene, const Plan& plan, std::int64_t first,
                                 const std::vector<double>& named);

}  // namespace grainreel
