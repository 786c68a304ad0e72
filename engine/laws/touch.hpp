// What a contact law is told of a touching pair (or of a grain and a wall), all at consistent time levels:
// geometry and closing speed at the end of the step, slip and twist over the step.
#pragma once

#include "engine/base/vector.hpp"

namespace grainreel {

struct Touch {
    Vec3 normal;            // unit k, from grain i to grain j, or from the grain to the wall
    double overlap;         // m, > 0
    double effective_mass;  // kg; set only for laws that use velocity
    double closing_speed;   // m/s, k . (v_i - v_j), > 0 when approaching; likewise
    Vec3 slip;              // m, of i over j at the contact during this step; set only for laws that rub
    double twist;           // rad, mean rotation of the two bodies about k during this step; likewise
    Vec3 slip_velocity;     // m/s, at the end of the step; set only for laws that rub and use velocity
};

}  // namespace grainreel
