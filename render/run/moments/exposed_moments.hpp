// The earlier moments that a picture is exposed over, kept until it is taken.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/run/moments/kept_moments.hpp"

namespace grainreel {

class ExposedMoments {
  public:
    ExposedMoments() = default;  // keeps nothing
    // multiples: periods after which the bed may repeat itself. Steps before `first` are not to be had:
    // pictures that begin there are exposed for less.
    ExposedMoments(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments,
                   const Clock& clock, const std::vector<int>& multiples, std::int64_t first);

    // At which a frame has to be kept.
    const std::set<std::int64_t>& steps() const { return moments_.steps(); }
    // Copies it, when it is one of those.
    void keep(const Frame& frame);
    // Sets Frame::exposed, of a bed that repeats itself after `periods`, and forgets what no later picture
    // wants.
    void fill(Frame& frame, int periods);
    // The picture at that step is not taken.
    void leave_out(std::int64_t step);

  private:
    std::vector<std::int64_t> steps_of(const Shot& shot, int periods) const;

    std::vector<FilmSegment> segments_;
    Clock clock_;
    std::int64_t first_ = 0;
    std::map<std::int64_t, int> segment_;  // of the picture at a step
    KeptMoments<FramePtr> moments_;
};

}  // namespace grainreel
