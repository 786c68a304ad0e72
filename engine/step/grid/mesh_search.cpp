#include "engine/step/grid/mesh_search.hpp"

#include <algorithm>

namespace grainreel {

namespace {

// Grains in sequence are near each other. So a mesh that is far from all of many is asked for but once.
class MeshSearch {
  public:
    MeshSearch(const Grains& grains, double skin, std::vector<WallNeighbour>& part)
        : grains_(grains), skin_(skin), part_(part) {}

    void list(const Surface& surface, std::int32_t mesh, const BodyPose& pose, std::int32_t begin,
              std::int32_t end) {
        if (end - begin <= kFew) {
            for (std::int32_t i = begin; i < end; ++i) {
                const Place& own = grains_.place[i];
                if (surface.any_within(pose.at_rest(own.position), own.radius + skin_))
                    part_.push_back({i, mesh});
            }
            return;
        }
        Eigen::AlignedBox3d centres;
        double largest = 0;
        for (std::int32_t i = begin; i < end; ++i) {
            centres.extend(grains_.place[i].position);
            largest = std::max(largest, grains_.place[i].radius);
        }
        const double reach = 0.5 * centres.sizes().norm() + largest + skin_;
        if (!surface.any_within(pose.at_rest(centres.center()), kMore * reach)) return;
        const std::int32_t half = begin + (end - begin) / 2;
        list(surface, mesh, pose, begin, half);
        list(surface, mesh, pose, half, end);
    }

  private:
    static constexpr std::int32_t kFew = 4;    // grains; to ask for each costs less
    static constexpr double kMore = 1 + 1e-6;  // for rounding, far from the origin too

    const Grains& grains_;
    double skin_;
    std::vector<WallNeighbour>& part_;
};

}  // namespace

void list_meshes(const Grains& grains, const std::vector<MeshWall>& meshes, const Pose& pose, double skin,
                 std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part) {
    part.clear();
    MeshSearch search(grains, skin, part);
    for (std::size_t m = 0; m < meshes.size(); ++m)
        search.list(*meshes[m].surface, static_cast<std::int32_t>(m), meshes[m].body.at(pose), begin, end);
    if (meshes.size() < 2) return;
    std::sort(part.begin(), part.end(), [](const WallNeighbour& a, const WallNeighbour& b) {
        return a.grain != b.grain ? a.grain < b.grain : a.face < b.face;
    });
}

}  // namespace grainreel
