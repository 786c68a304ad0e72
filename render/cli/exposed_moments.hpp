// The earlier moments that a picture is exposed over, kept until it is taken.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "render/cli/kept_moments.hpp"
#include "render/film/sampler.hpp"

namespace grainreel {

class ExposedMoments {
  public:
    ExposedMoments() = default;  // keeps nothing
    // Steps before `first` are not to be had: pictures that begin there are exposed for less.
    ExposedMoments(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments,
                   const Clock& clock, std::int64_t first);

    // At which a frame has to be kept.
    const std::set<std::int64_t>& steps() const { return moments_.steps(); }
    // Copies it, when it is one of those.
    void keep(const Frame& frame);
    // Sets Frame::exposed, and forgets what no later picture wants.
    void fill(Frame& frame);

  private:
    KeptMoments<FramePtr> moments_;
};

}  // namespace grainreel
