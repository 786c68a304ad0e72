// What the forces of one step are computed from.
#pragma once

#include "engine/state/glued_grains.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/geometry/walls.hpp"
#include "engine/step/lists/contact_rules.hpp"

namespace grainreel {

// All zero: the forces as they stand, for observers.
struct ForceTimes {
    double since = 0;    // s, time since the last forces
    double ahead = 0;    // steps, from the time of the known velocity to the time of these forces
    double acts = 0;     // s, how long these forces will act
    double turns = 0;    // s: `since`, or 0 where positions and velocities belong to one time
    double moved = 0;    // m; no grain has moved farther since the last refresh
    bool drags = false;  // grains settle or grow: those whose centres come through a mesh are pushed back
};

struct ForceInput {
    const ContactRules& rules;
    const Grains& grains;
    const WallState& walls;
    const GluedGrains& glued;
    const std::vector<MeshWall>& meshes;
    ForceTimes times;
};

}  // namespace grainreel
