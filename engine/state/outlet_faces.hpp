// What becomes of a container's faces when its outlet opens: the floor gets a slot or a hole, and the walls
// end below. Grains that have fallen through touch nothing but edges and the floor's underside.
//
// Every face stays under its number, so contacts and their histories go on: one that began on the floor goes
// on at the floor's edge.
#pragma once

#include <vector>

#include "engine/state/container_faces.hpp"

namespace grainreel {

// `faces` are those of container_faces(), perhaps with others behind them, which stay as they are.
void open_outlet(const Container& container, std::vector<Face>& faces);

}  // namespace grainreel
