// What frames that a run hands out want of its earlier steps, such as a picture that is exposed over a while.
// It is kept until the last frame that wants it has been handed out.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "engine/frame.hpp"

namespace grainreel {

// Ids, positions and bodies alone, and the moment.
Frame places_of(const Frame& frame);

struct WantedMoment {
    std::int64_t step = 0;
    bool whole = false;  // all of the grains; else places_of() them
};

class KeptMoments {
  public:
    // The frame that is handed out at a step wants these; such frames come by rising step.
    void want(std::int64_t frame, const std::vector<WantedMoment>& moments);
    // At which something has to be kept.
    std::set<std::int64_t> steps() const;
    // Copies of the frame what is wanted, when its step is one of those.
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

}  // namespace grainreel
