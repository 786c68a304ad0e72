// How far a surface is heaped up.
#pragma once

#include "engine/measure/surface/surface.hpp"

namespace grainreel {

struct Mound {
    double height = 0;  // m: mean of the middle third less that of the two outer sixths
    double slope = 0;   // tangent: mean rise of both halves towards the middle
    double tilt = 0;    // tangent: rise of the whole surface from left to right
};

// Slopes are those of least-squares lines through the bins. A tent of slope s over the width W has s, no
// tilt, and the height s W / 3; a plane has no slope. NaN with fewer than six bins.
Mound mound_of(const BedOutline& surface);

}  // namespace grainreel
