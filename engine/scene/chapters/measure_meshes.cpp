// The boxes that meshes move in.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"

namespace grainreel {
namespace {

constexpr int kMoments = 64;  // of a motion that is looked at

// All vertices, or, where they are many, the corners of the box around them.
std::vector<Vec3> points_of(const Surface& surface) {
    constexpr std::size_t many = 20'000;
    if (surface.mesh().vertices.size() <= many) return surface.mesh().vertices;
    const Vec3 &low = surface.facts().low, &high = surface.facts().high;
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back((k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z());
    return corners;
}

// Each point goes round in a circle.
void take_circles(const SceneMesh& mesh, Extent& extent) {
    const Vec3 &axis = mesh.turn->axis, &through = mesh.turn->through;
    const Vec3 reach = (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    for (const Vec3& point : mesh.surface->mesh().vertices) {
        const Vec3 along = axis.dot(point - through) * axis;
        const double radius = (point - through - along).norm();
        extent.take(through + along - radius * reach);
        extent.take(through + along + radius * reach);
    }
}

void take_turn(const SceneMesh& mesh, double duration, Extent& extent) {
    const double angle = mesh.turn->angle_at(duration);
    if (std::abs(angle) >= std::numbers::pi) return take_circles(mesh, extent);
    for (int k = 0; k <= kMoments; ++k) {
        const Quaternion rotation(Eigen::AngleAxisd(angle * k / kMoments, mesh.turn->axis));
        for (const Vec3& point : points_of(*mesh.surface))
            extent.take(mesh.turn->through + rotation * (point - mesh.turn->through));
    }
}

void take_path(const SceneMesh& mesh, double duration, Extent& extent) {
    const std::vector<Vec3> points = points_of(*mesh.surface);
    for (int k = 0; k <= kMoments; ++k) {
        const PathPose pose = mesh.path->at(duration * k / kMoments);
        for (const Vec3& point : points) extent.take(pose.place + pose.rotation * point);
    }
}

// Not much farther than it is large.
Vec3 way_of(const SceneMesh& mesh, double duration) {
    constexpr double farthest = 5;
    Vec3 way = duration * mesh.velocity;
    const double most = farthest * (mesh.high - mesh.low).norm();
    if (way.norm() > most) way *= most / way.norm();
    return way;
}

}  // namespace

void measure_meshes(Scene& scene) {
    for (SceneMesh& mesh : scene.meshes) {
        mesh.low = mesh.surface->facts().low, mesh.high = mesh.surface->facts().high;
        Extent extent{mesh.low, mesh.high};
        if (mesh.turn) take_turn(mesh, scene.run.duration, extent);
        if (mesh.path) take_path(mesh, scene.run.duration, extent);
        const Vec3 way = way_of(mesh, scene.run.duration);
        extent.take(mesh.low + way);
        extent.take(mesh.high + way);
        mesh.low = extent.low, mesh.high = extent.high;
    }
}

}  // namespace grainreel
