// What pictures of a run that goes on want of earlier steps, kept until the last picture that wants it has
// been taken.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "render/run/frames/picture_parts.hpp"

namespace grainreel {

class KeptMoments {
  public:
    // The picture at step `shot` wants these; pictures come by rising step.
    void want(std::int64_t shot, const std::vector<PictureParts::Moment>& moments);
    // At which something has to be kept.
    std::set<std::int64_t> steps() const;
    // Copies of the frame what is wanted, when its step is one of those.
    void keep(const Frame& frame);
    // Null when it was not kept.
    FramePtr at(std::int64_t step) const;
    // The picture is taken, or left out: forgets what no later one wants.
    void done_with(std::int64_t shot);

  private:
    struct Wanted {
        bool whole = false;
        std::int64_t last_shot = 0;  // that wants it
    };
    std::map<std::int64_t, Wanted> wanted_;                   // by step
    std::map<std::int64_t, std::set<std::int64_t>> of_shot_;  // steps
    std::map<std::int64_t, FramePtr> kept_;
};

}  // namespace grainreel
