#include "engine/measure/segregation/side_walls.hpp"

#include <algorithm>

#include "engine/measure/walls/turning.hpp"

namespace grainreel {

SideWalls::SideWalls(const Scene& scene) {
    const bool stands = !turns_over(scene);  // else its walls are at its sides by turns
    for (const Face& face : container_faces(scene.container, scene.drive))
        if (stands && (face.kind == Face::Kind::cylinder || face.normal.y() != 0)) faces_.push_back(face);
    if (scene.species.empty()) return;
    gap_ =
        std::min_element(scene.species.begin(), scene.species.end(), [](const Species& a, const Species& b) {
            return a.diameter.mean < b.diameter.mean;
        })->diameter.mean;
}

Side SideWalls::side_of(const Place& grain, const Pose& pose) const {
    const bool beside = std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
        return distance_to(face, face.displacement(pose), grain.position).distance < grain.radius + gap_;
    });
    if (!beside) return Side::none;
    return grain.position.y() < pose.offset.y() ? Side::left : Side::right;
}

}  // namespace grainreel
