// The forces that an answer is about, where they act, and words about them for a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/questions/snapshot.hpp"
#include "engine/state/point_force.hpp"

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

}  // namespace grainreel
