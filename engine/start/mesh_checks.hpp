// What can be wrong with a scene's meshes beside its grains and its other walls.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/wall_motion.hpp"

namespace grainreel {

// Throws UserError, at the mesh's or the feed's place in the scene, where a mesh lies far from all grains,
// moves into another wall, or a feed's box reaches into it. Adds to the plan's warnings what was not looked
// at.
void check_meshes(const Scene& scene, Plan& plan);

// The parts of it; they throw as above.
//
// A grain is near where it starts, where it is fed, and where it may fly and fall to from there: in a closed
// container nowhere else, else as far as ten times that box to all sides, and down as far as a free fall.
void check_meshes_near(const Scene& scene, const Plan& plan);
void check_feed_boxes(const Scene& scene);
// Looks at 72 moments: of the first turn of a mesh that turns, else of the run. Against faces: whether a
// corner that was before a face gets behind it. Against another mesh: whether edges of one cross triangles of
// the other elsewhere than at rest. What is less deep than 1 % of the smallest extent does not count, nor
// what happens at the rim of an open mesh, so that a drum and its end caps may touch. Meshes that cross at
// rest go on crossing where they do: a shaft may pass through a wall.
void check_mesh_paths(const Scene& scene, Plan& plan);

// The moments at which the motion of meshes is looked at before a run.

constexpr int kMomentsOfMotion = 72;

// Whether the two always move alike, or both stand still.
bool move_alike(const Body& one, const Body& other, bool drive_moves);

// Steps at which a body is looked at, by rising number, the first being 0: each 5 degrees of its first turn,
// or evenly over the run; and eight phases of the drive where that moves it. Only 0 where it stands still.
std::vector<std::int64_t> moments_of(const Body& body, const Scene& scene, const Plan& plan);

}  // namespace grainreel
