// Neighbour lists with a skin: all grains and walls that are less than a certain gap, the skin, from contact.
// They hold every pair closer than r_i + r_j + skin once, under the grain with the lower index. The lists are
// valid until grains and walls have moved too far for the skin.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/grid/cells.hpp"
#include "engine/step/surroundings.hpp"

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
    // Puts in `part`, the list of the grains from `grain` on. Their partners begin at place `at`. Several
    // threads may put in their parts at the same time.
    void put(const NeighbourList& part, std::size_t grain, std::size_t at);
};

struct WallNeighbour {
    std::int32_t grain;
    std::int32_t face;  // number of the face, the glued grain or the mesh
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

// list_pairs() and list_walls() need the grains in this order. They list the neighbours of the grains [begin,
// end) only. In the part that list_pairs() makes, start[0] belongs to grain `begin`.
void list_pairs(const Cells& cells, const Grains& grains, double skin, double period, std::int32_t begin,
                std::int32_t end, NeighbourList& part);
void list_walls(const Grains& grains, const std::vector<Face>& faces, const DrivePose& pose, double skin,
                std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part);

// keep_near() may read and write this many numbers after the candidates.
constexpr std::int32_t kNearSlack = 16;

// Moves the near candidates to the front, in their order, and returns how many they are. A candidate is near
// if its index is above i and its distance is less than the sum of both radii and `skin` (m).
// `period` is the period of x in m, or 0.
std::int32_t keep_near(const Grains& grains, std::int32_t i, double skin, double period,
                       std::int32_t* candidates, std::int32_t count);

// Finds the glued grains near a place. They are sorted into boxes once, at rest, and the boxes move with the
// body that carries the grains.
class GluedSearch {
  public:
    // Glued grains and faces must outlive the search. `period` is the period of x in m, or 0.
    GluedSearch(const GluedGrains& glued, const std::vector<Face>& faces, double period);

    // Calls each(number, distance) for all glued grains whose surface is closer to `centre` than `gap` (m),
    // at a pose of the drive, in no particular order.
    template <class Each>
    void near(const Vec3& centre, double gap, const DrivePose& pose, const Each& each) const {
        for (const OfBody& part : parts_) {
            const Vec3 at_rest = centre - part.body.place_at(pose);
            part.grid.near(at_rest, gap + largest_, false, [&](const std::int32_t* first, const auto* last) {
                for (; first != last; ++first)
                    if (const double distance = distance_to(*first, at_rest); distance < gap)
                        each(*first, distance);
            });
        }
    }

    // Lists the glued grains near the grains [begin, end), by rising grain, then glued grain.
    void list(const Grains& grains, const DrivePose& pose, double skin, std::int32_t begin, std::int32_t end,
              std::vector<WallNeighbour>& part) const;

  private:
    struct OfBody {
        Body body;
        Grid grid;
    };
    // Distance (m) from a place to the surface of glued grain g, in the frame of the body.
    double distance_to(std::int32_t g, const Vec3& at_rest) const {
        Vec3 apart = at_rest - at_rest_[g].position;
        apart.x() = wrapped(apart.x(), period_);
        return apart.norm() - at_rest_[g].radius;
    }

    const double period_;
    double largest_ = 0;  // m, radius
    LargeArray<Place> at_rest_;
    std::vector<OfBody> parts_;
};

// Lists every mesh whose surface is closer than `skin` (m) to the surface of one of the grains [begin, end),
// by rising grain, then mesh.
void list_meshes(const Grains& grains, const std::vector<MeshWall>& meshes, const DrivePose& pose,
                 double skin, std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part);

}  // namespace grainreel
