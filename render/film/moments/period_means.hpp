// Grains where they were on average over whole periods of the drive: what is left of the motion is drift.
#pragma once

#include <vector>

#include "engine/frame.hpp"

namespace grainreel {

// Positions become means over the moments, velocities how far the span has moved things, of grains and
// bodies. moments: by rising time, the first of them closes the span and is not in the mean, the last is the
// frame's own. span: s between these two. depth: m, along x, after which a periodic container repeats; 0 for
// none. A grain that was not there at all of the moments stays as it is.
void set_mean(Frame& frame, const std::vector<FramePtr>& moments, double span, double depth);

}  // namespace grainreel
