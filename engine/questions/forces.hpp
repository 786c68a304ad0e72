// What pushes the grains of a snapshot that was brought back, so that its forces are known.
#pragma once

#include <string>
#include <vector>

#include "engine/questions/snapshot.hpp"

namespace grainreel {

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
