// At which steps a run stops, and why: for the frames that a film wants, for earlier moments that these need,
// for rows of files, and for key moments. FilmWishes holds what a film or another program wants beyond the
// run's files. KeptStates keeps earlier moments, which a picture with an exposure time needs, for example.
// Agenda merges all stops in order of time.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/plan/times.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

// A frame with only the moment (time, phase, poses of bodies), the ids and the positions of this one.
State places_of(const State& frame);

struct WantedState {
    std::int64_t step = 0;
    bool whole = false;  // whether the whole frame is kept, or only places_of() the frame
};

// Keeps earlier moments. A moment is kept until the last frame that needs it has been handed out.
class KeptStates {
  public:
    // Says which moments the frame handed out at step `frame` needs. Frames must come by rising step.
    void want(std::int64_t frame, const std::vector<WantedState>& moments);
    // The steps at which a moment has to be kept.
    std::set<std::int64_t> steps() const;
    // Copies the wanted parts of the frame, if its step is one of steps().
    void keep(const State& frame);
    // The moment at a step; null if it was not kept.
    StatePtr at(std::int64_t step) const;
    // Call this when the frame of a step has been handed out or left out. Forgets moments that no later frame
    // needs.
    void done_with(std::int64_t frame);

  private:
    struct Wanted {
        bool whole = false;
        std::int64_t last = 0;  // last frame that needs it
    };
    std::map<std::int64_t, Wanted> wanted_;                    // by step
    std::map<std::int64_t, std::set<std::int64_t>> of_frame_;  // steps that the frame of a step needs
    std::map<std::int64_t, StatePtr> kept_;
};

// Wishes of a film, or of a program that looks at the grains now and then, that go beyond the files of the
// scene.
struct FilmWishes {
    // Steps at which frames are handed out (RunDriver::next()), rising. Those before the run's first step do
    // not come.
    std::vector<std::int64_t> steps;
    // Called when the run has come to such a step. Returns whether its frame is no longer wanted. Without it
    // all frames are wanted.
    std::function<bool(std::int64_t step)> left_out;
    // Called at each step at which the run stops, before anything else is done there.
    std::function<void(const SimulatedBed&)> look;
    // Earlier moments that those frames will need.
    KeptStates kept;
    // Whether frames that are handed out also go into film_moments.nc. A resumed run does so if it did so
    // before.
    bool to_file = false;
    // Whether the rows of measures.csv also stay in memory (RunFiles::measures()).
    bool keep_rows = false;
    // Whether key moments are kept with their contacts. A resumed run does so if it did so before.
    bool key_moments = false;
    // Times (s of simulated time) of key moments besides the usual ones.
    std::vector<double> key_times;
};

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

// Merges all stops of a run.
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
