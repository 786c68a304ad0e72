#include "engine/step/lists/wall_ways.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {

namespace {

bool are_parallel(const Vec3& a, const Vec3& b) {
    return a.cross(b).squaredNorm() < 1e-24;
}

// m. A turn by an angle moves what is a length from the axis by 2 sin(angle / 2) of it.
double way_of(const Body& body, const Vec3& centre, double radius, const Pose& before, const Pose& now,
              const Vec3& flown) {
    const BodyPose was = body.at(before), is = body.at(now);
    const Vec3 gone = is.moved(centre) - was.moved(centre) - flown;
    const double turned = 2 * (is.rotation * was.rotation.conjugate()).vec().norm();
    return gone.norm() + turned * radius;
}

double speed_of(const Body& body, const Vec3& centre, double radius, const Pose& now, const Vec3& frame) {
    const BodyPose is = body.at(now);
    return (is.velocity_at(is.moved(centre)) - frame).norm() + is.spin.norm() * radius;
}

}  // namespace

WallWays::WallWays(const Surroundings& around) : around_(around) {
    for (const MeshWall& mesh : around.meshes) of_meshes_.push_back(swing_of(mesh));
}

// A plane across the axis, and a cylinder about it, stay where they are as they turn.
WallWays::Swing WallWays::swing_of(const Face& face) {
    if (!face.body.turn) return {face.point, face.reach};
    const bool stays = face.kind == Face::Kind::cylinder || are_parallel(face.normal, face.body.turn->axis);
    if (face.kind == Face::Kind::cylinder) return {face.point, 0};
    return {face.body.turn->through, stays ? 0 : face.reach};
}

WallWays::Swing WallWays::swing_of(const MeshWall& mesh) {
    const Body& body = mesh.body;
    if (!body.turns()) return {};
    if (body.path) {
        const Vec3 middle = 0.5 * (mesh.surface->facts().low + mesh.surface->facts().high);
        return {middle, mesh.surface->farthest_from(middle)};
    }
    return {body.turn->through, mesh.surface->farthest_from_axis(body.turn->through, body.turn->axis)};
}

double WallWays::farthest(const Pose& before, const Pose& now, const Vec3& flown) const {
    double squared = 0, of_turning = 0;
    for (const Face& face : around_.faces) {
        if (face.body.has_own_motion()) {
            const Swing swing = swing_of(face);
            of_turning =
                std::max(of_turning, way_of(face.body, swing.centre, swing.radius, before, now, flown));
            continue;
        }
        const Vec3 gone = face.displacement(now) - face.displacement(before) - flown;
        squared = std::max(squared, gone.squaredNorm());
    }
    for (std::size_t m = 0; m < of_meshes_.size(); ++m)
        of_turning = std::max(of_turning, way_of(around_.meshes[m].body, of_meshes_[m].centre,
                                                 of_meshes_[m].radius, before, now, flown));
    return std::max(std::sqrt(squared), of_turning);
}

double WallWays::fastest(const Pose& now, const Vec3& frame) const {
    double fastest = 0;
    for (const Face& face : around_.faces) {
        if (face.body.has_own_motion()) {
            const Swing swing = swing_of(face);
            fastest = std::max(fastest, speed_of(face.body, swing.centre, swing.radius, now, frame));
        } else {
            fastest = std::max(fastest, (face.velocity_at(now) - frame).norm());
        }
    }
    for (std::size_t m = 0; m < of_meshes_.size(); ++m)
        fastest = std::max(fastest, speed_of(around_.meshes[m].body, of_meshes_[m].centre,
                                             of_meshes_[m].radius, now, frame));
    return fastest;
}

}  // namespace grainreel
