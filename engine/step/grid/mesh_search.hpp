// Which grains are near meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// As list_walls(): under the grains [begin, end), by rising grain, then mesh. Every mesh whose surface is
// closer to a grain's surface than `skin` (m).
void list_meshes(const Grains& grains, const std::vector<MeshWall>& meshes, const Pose& pose, double skin,
                 std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part);

}  // namespace grainreel
