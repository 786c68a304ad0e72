// The forces of contacts on a grain or a wall: where they act, words about them for a picture, and their
// sums.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/questions/snapshot.hpp"
#include "engine/state/contact.hpp"

namespace grainreel {

struct AnswerForces {
    std::vector<PointForce> forces;
    std::vector<std::int32_t> grains;  // ids of grains that they act on or come from
    std::string words;                 // a few lines to show beside the grains
};

// Normal and tangential force of each contact of a grain, on this grain. The words say so where nothing
// touches it, and where the moment was not brought back and the forces are not known.
AnswerForces forces_on_grain(const Snapshot& snapshot, std::int64_t id);

// Forces of each contact of a wall, on the wall, at a moment that was brought back. Throws UserError where
// no wall has this name.
AnswerForces forces_on_wall(const Snapshot& snapshot, const std::string& name);

// Forces on the grains of a snapshot that was brought back, so that its forces are known.

// Sums over a grain's contacts: force in N, and torque in N m about its centre. 0 for an id that is not
// there.
Vec3 contact_force_on(const Snapshot& snapshot, std::int32_t id);
Vec3 contact_torque_on(const Snapshot& snapshot, std::int32_t id);

// The number of the wall called "left slant" or "left_slant", as contacts count walls: -1 - face. Throws
// UserError with a list of the walls.
std::int32_t wall_number(const Snapshot& snapshot, std::string name);
// The largest overlap that the plan aims at, divided by the smaller radius. (run.overlap is divided by the
// diameter.)
double overlap_limit(const Scene& scene);
// "run.overlap allows 0.02 of the smaller radius".
std::string overlap_limit_words(const Snapshot& snapshot);
// The contacts of a wall that push or pull.
std::vector<const DetailedContact*> pushes_on_wall(const Snapshot& snapshot, std::int32_t wall);

}  // namespace grainreel
