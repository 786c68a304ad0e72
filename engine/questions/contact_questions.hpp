// The forces that an answer is about, where they act, and words about them for a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/questions/snapshot.hpp"

namespace grainreel {

struct AnswerForces {
    std::vector<PointForce> forces;
    std::vector<std::int32_t> grains;  // ids of those that they act on or come from
    std::string words;                 // a few lines beside the grains
};

// Normal and tangential force of each contact of a grain, on this grain. Nothing touches a grain in flight:
// then the words say so. Of a moment that was not brought back the forces are not known, and the words say
// that.
AnswerForces forces_on_grain(const Snapshot& snapshot, std::int64_t id);

// Forces of each contact of a wall, on the wall, at a moment that was brought back. Throws UserError for a
// name that is no wall.
AnswerForces forces_on_wall(const Snapshot& snapshot, const std::string& name);

// What pushes the grains of a snapshot that was brought back, so that its forces are known.

// Sums over a grain's contacts; `id` need not be there. N, and N m about its centre.
Vec3 contact_force_on(const Snapshot& snapshot, std::int32_t id);
Vec3 contact_torque_on(const Snapshot& snapshot, std::int32_t id);

// "left slant" or "left_slant", as contacts count the faces: -1 - face. Throws UserError, which lists the
// walls.
std::int32_t wall_number(const Snapshot& snapshot, std::string name);
// Largest overlap over the smaller radius that the plan aims at. (run.overlap is over the diameter.)
double overlap_limit(const Scene& scene);
// "run.overlap allows 0.02 of the smaller radius".
std::string overlap_limit_words(const Snapshot& snapshot);
// Its contacts that push or pull.
std::vector<const ContactForce*> pushes_on_wall(const Snapshot& snapshot, std::int32_t wall);

}  // namespace grainreel
