// The clock of a record's moments.
#pragma once

#include <vector>

#include "engine/base/clock.hpp"
#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// A clock with steps of that length (s). With 0 it stands still.
Clock clock_of_steps(const Scene& scene, double step);

// The clock of a trajectory's frames, of which only the moments count. Its step is 0 when all are at step 0.
Clock clock_of(const Scene& scene, const std::vector<Frame>& moments);

}  // namespace grainreel
