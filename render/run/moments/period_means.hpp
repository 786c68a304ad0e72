// Grains where they were on average over whole periods of the drive: what is left of the motion is drift.
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

class PeriodMeans {
  public:
    PeriodMeans() = default;  // keeps nothing
    // first: the run's first step; before it the grains are taken to have been where they are then.
    // multiples: periods after which the bed may repeat itself. depth: m, along x, after which a periodic
    // container repeats; 0 for none.
    PeriodMeans(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments, const Clock& clock,
                const std::vector<int>& multiples, std::int64_t first, double depth);

    // At which positions have to be kept.
    const std::set<std::int64_t>& steps() const { return moments_.steps(); }
    // Copies them, when the step is one of those.
    void keep(const Frame& frame);
    // Positions become means over the periods up to the frame, a multiple of `periods`, velocities how far
    // that time has moved things, of grains and bodies. Forgets what no later picture wants.
    void fill(Frame& frame, int periods);
    // The picture at that step is not taken.
    void leave_out(std::int64_t step);

  private:
    struct Moment {
        std::vector<Vec3> position;
        std::vector<BodyPose> bodies;
    };
    std::vector<std::int64_t> steps_of(const Shot& shot, int periods) const;
    void average(Frame& frame, const std::vector<std::int64_t>& steps) const;

    std::vector<FilmSegment> segments_;
    Clock clock_;
    std::int64_t first_ = 0;
    double depth_ = 0;
    std::map<std::int64_t, int> segment_;  // of the picture at a step
    KeptMoments<Moment> moments_;
};

}  // namespace grainreel
