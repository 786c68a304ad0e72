// Earlier moments that the frames of a run need (KeptMoments), for example for a picture with an exposure
// time, and the wishes of a film or another program that go beyond the run's files (FrameWishes).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "engine/run/simulation/simulation.hpp"

namespace grainreel {

// A frame with only the ids, positions and bodies of this one.
Frame places_of(const Frame& frame);

struct WantedMoment {
    std::int64_t step = 0;
    bool whole = false;  // true for the whole frame, false for places_of() it
};

// A moment is kept until the last frame that needs it has been handed out.
class KeptMoments {
  public:
    // Says which moments the frame handed out at step `frame` needs. Frames must come by rising step.
    void want(std::int64_t frame, const std::vector<WantedMoment>& moments);
    // The steps at which a moment has to be kept.
    std::set<std::int64_t> steps() const;
    // Copies the wanted parts of the frame, if its step is one of steps().
    void keep(const Frame& frame);
    // The moment at a step; null if it was not kept.
    FramePtr at(std::int64_t step) const;
    // Call this when the frame of a step has been handed out or left out. Forgets moments that no later frame
    // needs.
    void done_with(std::int64_t frame);

  private:
    struct Wanted {
        bool whole = false;
        std::int64_t last = 0;  // last frame that needs it
    };
    std::map<std::int64_t, Wanted> wanted_;                    // by step
    std::map<std::int64_t, std::set<std::int64_t>> of_frame_;  // steps
    std::map<std::int64_t, FramePtr> kept_;
};

// Wishes of a film, or of a program that looks at the grains now and then, that go beyond the files of the
// scene.
struct FrameWishes {
    // Steps at which frames are handed out (RunDriver::next()), rising. Those before the run's first step do
    // not come.
    std::vector<std::int64_t> steps;
    // Called when the run has come to such a step. Returns whether its frame is no longer wanted. Without it
    // all frames are wanted.
    std::function<bool(std::int64_t step)> left_out;
    // Called at each step at which the run stops, before anything else is done there.
    std::function<void(const Simulation&)> look;
    // Earlier moments that those frames will need.
    KeptMoments kept;
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

}  // namespace grainreel
