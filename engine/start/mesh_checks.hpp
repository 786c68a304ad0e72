// Checks of a scene's meshes against its grains and its other walls.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"

namespace grainreel {

// Throws UserError, at the mesh's or the feed's place in the scene, where a mesh lies far from all grains,
// moves into another wall, or reaches into a feed's box. Adds to the plan's warnings what was not checked.
void check_meshes(const Scene& scene, Plan& plan);

// The parts of check_meshes; they throw in the same way.
//
// A mesh is near if grains can come to it: where they start, where they are fed, and where they may fly and
// fall to from there. In a closed container that is only its inside; else it is ten times that box to all
// sides, and as far down as a free fall goes.
void check_meshes_near(const Scene& scene, const Plan& plan);
void check_feed_boxes(const Scene& scene);
// Looks at 72 moments of the first turn of a mesh that turns, and of the whole run for other meshes. No
// corner of a mesh may get from the front of a face to its back, and no edge of a mesh may cross a triangle
// of another mesh elsewhere than at rest. A crossing less deep than 1 % of the smallest extent does not
// count, and neither does one at the rim of an open mesh, so that a drum and its end caps may touch. Meshes
// that cross at rest may go on crossing there: a shaft may pass through a wall.
void check_mesh_paths(const Scene& scene, Plan& plan);

// The moments at which the motion of meshes is checked before a run.

constexpr int kMomentsOfMotion = 72;

// Whether two bodies always move alike, or both stand still.
bool move_alike(const Body& one, const Body& other, bool drive_moves);

// Steps at which a body is checked, by rising number, the first being 0. They come each 5 degrees of its
// first turn, or evenly over the run; where the drive moves the body, eight phases of the drive are added.
// A body that stands still has only step 0.
std::vector<std::int64_t> moments_of(const Body& body, const Scene& scene, const Plan& plan);

}  // namespace grainreel
