// Grains where they were on average over whole periods of the drive: what is left of the motion is drift.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "render/cli/kept_moments.hpp"
#include "render/film/sampler.hpp"

namespace grainreel {

class PeriodMeans {
  public:
    PeriodMeans() = default;  // keeps nothing
    // first: the run's first step; before it the grains are taken to have been where they are then.
    // depth: m, along x, after which a periodic container repeats; 0 for none.
    PeriodMeans(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments, const Clock& clock,
                std::int64_t first, double depth);

    // At which positions have to be kept.
    const std::set<std::int64_t>& steps() const { return moments_.steps(); }
    // Copies them, when the step is one of those.
    void keep(const Frame& frame);
    // Positions become means over the periods up to the frame, velocities how far that time has moved things,
    // of grains, walls and floor. Forgets what no later picture wants.
    void fill(Frame& frame);

  private:
    struct Moment {
        std::vector<Vec3> position;
        Vec3 wall{0, 0, 0}, floor{0, 0, 0};
    };
    void average(Frame& frame, const std::vector<std::int64_t>& steps) const;

    double depth_ = 0;
    std::map<std::int64_t, double> span_;  // s, of the mean at a step
    KeptMoments<Moment> moments_;
};

}  // namespace grainreel
