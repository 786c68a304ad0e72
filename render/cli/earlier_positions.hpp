// How far each grain came in the last period of the drive: the positions of one period before every picture,
// kept until the picture is taken.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/frame.hpp"
#include "render/cli/kept_moments.hpp"
#include "render/film/sampler.hpp"

namespace grainreel {

// From `before`, in the same order, to where the grains are now. depth: m, along x, after which a periodic
// container repeats; 0 for none. Nothing is set when grains have come or gone.
void set_displacement(Frame& now, const std::vector<Vec3>& before, double depth);

class EarlierPositions {
  public:
    EarlierPositions() = default;  // keeps nothing
    // Steps before `first` are not to be had. depth: as above.
    EarlierPositions(const std::vector<Shot>& shots, std::int64_t steps_per_period, std::int64_t first,
                     double depth);

    // At which a frame has to be kept.
    const std::set<std::int64_t>& steps() const { return moments_.steps(); }
    // Copies the positions, when the step is one of those.
    void keep(const Frame& frame);
    // Gives the frame its displacements, when that of one period before was kept, and forgets older ones.
    void fill(Frame& frame);

  private:
    std::int64_t period_ = 0;
    double depth_ = 0;
    KeptMoments<std::vector<Vec3>> moments_;
};

}  // namespace grainreel
