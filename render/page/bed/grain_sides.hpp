// On which side of each triangle of a mesh the grains are. A wall looks solid from that side and is glass
// from the other one, as the film has it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/motion/turn.hpp"

namespace grainreel {

// front: the side that the normal points to. both: it is solid from either side, as a blade among grains is.
enum class GrainSide : std::uint8_t { both, front, back };

// grains: places of some of them, m, in the frame of the mesh. turn: about which it turns, if it does.
// tumbles: its axis changes.
//
// A mesh around the grains has them where its room is. A closed one among them has them around it. Of an open
// one, each patch has them where their middle is, or the axis of a mesh that turns, unless that is in the
// patch's own plane. A patch is what hangs together without a sharp edge.
std::vector<GrainSide> grain_sides(const std::shared_ptr<const Surface>& surface,
                                   const std::vector<Vec3>& grains, const std::optional<BodyTurn>& turn,
                                   bool tumbles);

}  // namespace grainreel
