// The grains that the film shows: all but those of hidden species. The others are as if they were not there:
// they are not lit, cast nothing and are not counted in fields.
#pragma once

#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class ShownGrains {
  public:
    explicit ShownGrains(const Scene& scene);

    // The frame itself when nothing is hidden, otherwise a copy that the next call overwrites.
    const Frame& of(const Frame& frame);

  private:
    std::vector<bool> hidden_;  // by species
    bool any_ = false;
    Frame shown_;
};

}  // namespace grainreel
