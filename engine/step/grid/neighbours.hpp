// Neighbour lists with a skin: every pair closer than r_i + r_j + skin, once, under the grain with the lower
// index. Also the grains near a wall. Valid until grains and walls have moved too far for the skin.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/nearest_image.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/grid/cells.hpp"

namespace grainreel {

struct NeighbourList {
    std::vector<std::int32_t> start;    // grain i's partners are partner[start[i]] .. partner[start[i + 1]]
    std::vector<std::int32_t> partner;  // indices of the other grains, all above i, rising
    std::int32_t farthest_partner = 0;  // no partner's index is farther from i than this

    std::size_t size() const { return partner.size(); }
    void resize(std::size_t grains, std::size_t partners) {
        start.resize(grains + 1), partner.resize(partners);
        start[0] = 0;
    }
    // The list of the grains from `grain` on, their partners from place `at` on: several threads may put
    // theirs at once.
    void put(const NeighbourList& part, std::size_t grain, std::size_t at);
};

struct WallNeighbour {
    std::int32_t grain;
    std::int32_t face;
};

struct NeighbourLists {
    NeighbourList pairs;
    std::vector<WallNeighbour> walls;  // by rising grain, then face
};

// Wraps positions into the period, puts the grains in spatial order and lays the cells over them.
// index[old] = new. All members of a team call it. The loads must have been used up.
void put_in_order(const TeamMember& me, Cells& cells, Grains& grains, double skin, double period,
                  std::vector<std::int32_t>& index);

// All want the grains in that order. They list under the grains [begin, end) only, list_pairs with a start
// counting from 0 at `begin`.
void list_pairs(const Cells& cells, const Grains& grains, double skin, double period, std::int32_t begin,
                std::int32_t end, NeighbourList& part);
void list_walls(const Grains& grains, const std::vector<Face>& faces, const Pose& pose, double skin,
                std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part);

}  // namespace grainreel
