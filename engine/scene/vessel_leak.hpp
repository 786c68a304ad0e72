// Where a vessel does not hold its grains.
#pragma once

#include <optional>

#include "engine/mesh/room.hpp"

namespace grainreel {

// m, a place near which a grain of this diameter (m) gets out of the room of a vessel; empty where none is
// found. Out of a vessel that is open above nothing is lost over its rim, so only what lies below the rim
// counts; a closed one must be closed all round. Two searches, neither of which minds sheets that stand in
// the room, seams whose vertices do not meet, or walls with a thickness:
// - from the room to the box around the vessel in steps of a 32nd of its size: finds every hole that is
// wider,
//   in walls of any kind;
// - at the open edges: whether a diameter beyond one of them the room goes over into what is not room.
std::optional<Vec3> leak_of(const Surface& surface, const EnclosedRoom& room, double diameter);

}  // namespace grainreel
