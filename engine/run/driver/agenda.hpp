// The steps at which a run stops, for frames that are handed out, rows of files, and key moments for the
// run's page. All are merged in order of time.
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
    bool moment = false;  // a frame that is handed out later needs this moment
    bool fields = false;  // a record of fields ends
    bool key = false;     // a key moment (key_steps())
};

class Agenda {
  public:
    // Stops from step `first` to `last`. `frames` are rising steps; steps before `first` are left out.
    // Trajectory and measures come at the steps of their rhythms, measures at `first` and `last` too.
    // `moments` are steps, `clock` gives the periods of the drive, and `fields` is null without fields.
    Agenda(std::vector<std::int64_t> frames, const Rhythm& trajectory, const Rhythm& measures,
           std::int64_t first, std::int64_t last, std::set<std::int64_t> moments = {},
           const Clock& clock = {}, const FieldTimes* fields = nullptr);

    // Call this if the run has begun before `first`. Measures then come at `first` only if they are due.
    void goes_on() { begins_ = false; }

    // Adds stops at these steps.
    void want_keys(std::set<std::int64_t> steps) { keys_ = std::move(steps); }

    // The next stop, in rising order of step. The last stop is at `last`; after it the result is empty.
    std::optional<Stop> next();

  private:
    std::vector<std::int64_t> frames_;
    std::size_t frame_ = 0;  // the next of the frames
    std::set<std::int64_t> moments_, keys_;
    Rhythm trajectory_, measures_;
    Clock clock_;
    std::optional<FieldTimes> fields_;
    std::int64_t first_, last_;
    std::int64_t at_;  // steps below this one are done
    bool begins_ = true;
};

// Returns the steps of a run's key moments, from `first` to the plan's last. At key moments a run keeps all
// contacts with their forces for its page (key_moments.nc, key_contacts.nc). They are the start, the end and
// the two periods before it, the times `named` (s of simulated time, for example the beginnings of a film's
// captions), and some in between. With more grains there are fewer of them, so that both files together take
// about 40 MB; there are none if a single moment takes more.
std::set<std::int64_t> key_steps(const Scene& scene, const Plan& plan, std::int64_t first,
                                 const std::vector<double>& named);

}  // namespace grainreel
