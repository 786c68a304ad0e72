// A frame without the grains of some species. Those are as if they were not there: they are not lit, cast
// nothing and are not counted in fields.
#pragma once

#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class ShownGrains {
  public:
    // left_out: species, indices into scene.species.
    ShownGrains(const Scene& scene, const std::vector<std::size_t>& left_out);

    // The frame itself when nothing is left out, otherwise a copy that the next call overwrites.
    const Frame& of(const Frame& frame);

  private:
    std::vector<bool> left_out_;  // by species
    bool any_ = false;
    Frame shown_;
};

}  // namespace grainreel
