// The moments at which the motion of meshes is looked at before a run.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/wall_motion.hpp"

namespace grainreel {

constexpr int kMomentsOfMotion = 72;

// Whether the two always move alike, or both stand still.
bool move_alike(const Body& one, const Body& other, bool drive_moves);

// Steps at which a body is looked at, by rising number, the first being 0: each 5 degrees of its first turn,
// or evenly over the run; and eight phases of the drive where that moves it. Only 0 where it stands still.
std::vector<std::int64_t> moments_of(const Body& body, const Scene& scene, const Plan& plan);

}  // namespace grainreel
