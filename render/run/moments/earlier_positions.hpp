// How far each grain came in a period of the drive: earlier positions for every picture, kept until it is
// taken.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/run/moments/kept_moments.hpp"

namespace grainreel {

// From `before`, in the same order, to where the grains are now, by the periods between. depth: m, along x,
// after which a periodic container repeats; 0 for none. Nothing is set when grains have come or gone.
void set_displacement(Frame& now, const std::vector<Vec3>& before, int periods, double depth);

class EarlierPositions {
  public:
    EarlierPositions() = default;  // keeps nothing
    // Steps before `first` are not to be had. multiples: periods after which the bed may repeat itself.
    // depth: as above.
    EarlierPositions(const std::vector<Shot>& shots, std::int64_t steps_per_period,
                     const std::vector<int>& multiples, std::int64_t first, double depth);

    // At which a frame has to be kept.
    const std::set<std::int64_t>& steps() const { return moments_.steps(); }
    // Copies the positions, when the step is one of those.
    void keep(const Frame& frame);
    // Gives the frame its displacements a period over the last `periods`, when that far before was kept, and
    // forgets what no later picture wants.
    void fill(Frame& frame, int periods);
    // The picture at that step is not taken.
    void leave_out(std::int64_t step) { moments_.done_with(step); }

  private:
    std::int64_t period_ = 0;
    double depth_ = 0;
    KeptMoments<std::vector<Vec3>> moments_;
};

}  // namespace grainreel
