// How much of the container, up to a height, is filled by grains.
#pragma once

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Volume of the grains below `top` over the container's volume between `floor` and `top`; both m, in the
// room. A grain that reaches through the plane z = top counts by its part below: a cap of height h of a
// sphere of radius r has the volume pi h^2 (3 r - h) / 3. NaN in empty space, and where top is not above
// floor.
double solid_fraction(const Container& container, const Grains& grains, double floor, double top);

}  // namespace grainreel
