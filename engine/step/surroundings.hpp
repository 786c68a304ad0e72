// The surroundings of the grains.
#pragma once

#include <vector>

#include "engine/state/container_faces.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/traffic.hpp"
#include "engine/state/wall_motion.hpp"

namespace grainreel {

// The step loop reads them and never changes them.
struct Surroundings {
    std::vector<Face> faces;
    GluedGrains glued;  // to these faces
    WallMotion motion;
    Vec3 gravity{0, 0, 0};    // m/s2
    double period = 0;        // m, of x; 0 for none
    double skin = 0;          // m, of the first neighbour lists; later ones follow the motion
    std::vector<Exit> exits;  // through which grains leave; may change between two runs
};

}  // namespace grainreel
