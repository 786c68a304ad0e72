#include "engine/step/grid/mesh_search.hpp"

#include <algorithm>

namespace grainreel {

void list_meshes(const Grains& grains, const std::vector<MeshWall>& meshes, const Pose& pose, double skin,
                 std::int32_t begin, std::int32_t end, std::vector<WallNeighbour>& part) {
    part.clear();
    if (meshes.empty()) return;
    std::vector<BodyPose> poses;
    for (const MeshWall& mesh : meshes) poses.push_back(mesh.body.at(pose));
    for (std::int32_t i = begin; i < end; ++i) {
        const Place& own = grains.place[i];
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            if (meshes[m].surface->any_within(poses[m].at_rest(own.position), own.radius + skin))
                part.push_back({i, static_cast<std::int32_t>(m)});
        }
    }
}

}  // namespace grainreel
