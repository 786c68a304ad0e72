// How far each grain came in a period of the drive.
#pragma once

#include "engine/frame.hpp"

namespace grainreel {

// From `before` to where the grains are now, by the periods between; NaN for a grain that was not there
// before. depth: m, along x, after which a periodic container repeats; 0 for none.
void set_displacement(Frame& now, const Frame& before, int periods, double depth);

}  // namespace grainreel
