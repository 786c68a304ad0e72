// Earlier moments that the frames of a run need (KeptMoments), such as for a picture that is exposed over a
// while, and all that a film or another program wants of a run beside its files (FrameWishes).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "engine/run/simulation/simulation.hpp"

namespace grainreel {

// The frame's moment with ids, positions and bodies alone.
Frame places_of(const Frame& frame);

struct WantedMoment {
    std::int64_t step = 0;
    bool whole = false;  // all of the frame; else places_of() it
};

// A moment is kept until the last frame that needs it has been handed out.
class KeptMoments {
  public:
    // The frame that is handed out at a step wants these; such frames come by rising step.
    void want(std::int64_t frame, const std::vector<WantedMoment>& moments);
    // The steps at which something has to be kept.
    std::set<std::int64_t> steps() const;
    // Copies what is wanted of the frame, when its step is one of those.
    void keep(const Frame& frame);
    // Null when it was not kept.
    FramePtr at(std::int64_t step) const;
    // The frame of that step is handed out, or left out: forgets what no later one wants.
    void done_with(std::int64_t frame);

  private:
    struct Wanted {
        bool whole = false;
        std::int64_t last = 0;  // frame that wants it
    };
    std::map<std::int64_t, Wanted> wanted_;                    // by step
    std::map<std::int64_t, std::set<std::int64_t>> of_frame_;  // steps
    std::map<std::int64_t, FramePtr> kept_;
};

// What somebody wants of a run on its way beside the files that its scene asks for: a film, or a program that
// looks at the grains now and then.
struct FrameWishes {
    // Steps at which frames are handed out (RunDriver::next()), rising. Those before the run's first step do
    // not come.
    std::vector<std::int64_t> steps;
    // Asked when the run has come to such a step: whether its frame is not wanted any more. None: all are
    // wanted.
    std::function<bool(std::int64_t step)> left_out;
    // Told of each step at which the run stops, before anything is done with it.
    std::function<void(const Simulation&)> look;
    // Earlier moments that those frames will want.
    KeptMoments kept;
    // Whether frames that are handed out go into film_moments.nc too. A run that goes on does what it did.
    bool to_file = false;
    // Whether the rows of measures.csv stay in memory too (RunFiles::measures()).
    bool keep_rows = false;
    // Whether key moments are kept with their contacts. A run that goes on does what it did.
    bool key_moments = false;
    // s of simulated time: key moments beside the usual ones.
    std::vector<double> key_times;
};

}  // namespace grainreel
