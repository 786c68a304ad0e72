// How far each grain came in a period of the drive.
#pragma once

#include "engine/frame.hpp"

namespace grainreel {

// From `before` to where the grains are now, by the periods between. Both list the same grains in the same
// order; nothing is set when grains have come or gone. depth: m, along x, after which a periodic container
// repeats; 0 for none.
void set_displacement(Frame& now, const Frame& before, int periods, double depth);

}  // namespace grainreel
