// Neighbour lists with a skin. They hold every pair closer than r_i + r_j + skin once, under the grain with
// the lower index, and the grains near walls. They are valid until grains and walls have moved too far for
// the skin.
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
    std::int32_t farthest_partner = 0;  // the largest difference between a partner's index and i

    std::size_t size() const { return partner.size(); }
    void resize(std::size_t grains, std::size_t partners) {
        start.resize(grains + 1), partner.resize(partners);
        start[0] = 0;
    }
    // Puts in the list of the grains from `grain` on; their partners stand from place `at` on. Several
    // threads may put in their parts at the same time.
    void put(const NeighbourList& part, std::size_t grain, std::size_t at);
};

struct WallNeighbour {
    std::int32_t grain;
    std::int32_t face;  // or the number of a glued grain, or of a mesh
};

struct NeighbourLists {
    NeighbourList pairs;
    std::vector<WallNeighbour> walls;   // by rising grain, then face
    std::vector<WallNeighbour> glued;   // by rising grain, then glued grain
    std::vector<WallNeighbour> meshes;  // by rising grain, then mesh
};

// Wraps positions into the period, puts the grains in spatial order and lays the cells over them. Sets
// index[old] = new. All members of a team call it. The loads must be zero.
void put_in_order(const TeamMember& me, Cells& cells, Grains& grains, double skin, double period,
                  std::vector<std::int32_t>& index);

// Both need the grains in that order, and list under the grains [begin, end) only. In the part that
// list_pairs() makes, start[0] belongs to grain `begin`.
void list_pairs(const Cells& cells, const Grains& grains, double skin, double period, std::int32_t begin,
                std::int32_t end, NeighbourList& part);
void list_walls(const Grains& grains, const std::vector<Face>& faces, const Pose& pose, double skin,
                std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part);

}  // namespace grainreel
