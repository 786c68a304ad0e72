#include "engine/start/fallen.hpp"

#include <algorithm>
#include <limits>

#include "engine/mesh/surface.hpp"

namespace grainreel {

namespace {

// How far (m) a mesh reaches in a direction, before anything moves.
double farthest(const MeshWall& mesh, const DrivePose& rest, const Vec3& direction) {
    const BodyPose pose = mesh.body.at(rest);
    const MeshFacts& facts = mesh.surface->facts();
    double most = -std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 place = facts.low;
        for (int axis = 0; axis < 3; ++axis)
            if (corner >> axis & 1) place[axis] = facts.high[axis];
        most = std::max(most, direction.dot(pose.moved(place)));
    }
    return most;
}

}  // namespace

FallenGrains::FallenGrains(const Scene& scene, const Surroundings& around) : scene_(scene) {
    const double gravity = around.gravity.norm();
    if (scene.exits.empty() || gravity == 0) return;
    down_ = around.gravity / gravity;
    none_falls_ = std::any_of(around.faces.begin(), around.faces.end(), [&](const Face& face) {
        return face.kind != Face::Kind::plane || face.normal.dot(down_) < 0;
    });
    lowest_ = -std::numeric_limits<double>::infinity();
    constexpr std::int64_t kBefore = -1;  // before the drive starts
    for (const MeshWall& mesh : around.meshes)
        lowest_ = std::max(lowest_, farthest(mesh, around.motion.at(kBefore), down_));
}

void FallenGrains::stop(Grains& grains) const {
    if (none_falls_) return;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Place& place = grains.place[i];
        if (down_.dot(place.position) - place.radius < lowest_) continue;
        const bool leaves = std::any_of(scene_.exits.begin(), scene_.exits.end(),
                                        [&](const ExitBox& exit) { return exit.holds(place.position); });
        if (!leaves) continue;
        grains.motion[i].velocity.setZero();
        grains.motion[i].spin.setZero();
    }
}

}  // namespace grainreel
