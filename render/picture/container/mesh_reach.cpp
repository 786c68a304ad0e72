#include "render/picture/container/mesh_reach.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

constexpr int kDirections = 256;  // over the sphere, 0.2 apart: 0.5 % of a round body's radius is cut off
constexpr int kTurns = 48, kPathPlaces = 64;

std::vector<Vec3> outermost(const std::vector<Vec3>& points) {
    std::vector<Vec3> kept;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kDirections + 6 && !points.empty(); ++i) {
        const double z = 1 - (2 * i + 1.0) / kDirections, out = std::sqrt(std::max(0.0, 1 - z * z));
        Vec3 along(out * std::cos(golden * i), out * std::sin(golden * i), z);
        if (i >= kDirections) along = (i % 2 ? -1 : 1) * Vec3::Unit((i - kDirections) / 2);
        const auto farther = [&](const Vec3& a, const Vec3& b) { return a.dot(along) < b.dot(along); };
        kept.push_back(*std::max_element(points.begin(), points.end(), farther));
    }
    return kept;
}

std::vector<Vec3> reach_of(const SceneMesh& mesh) {
    const std::vector<Vec3> rest = outermost(mesh.surface->mesh().vertices);
    std::vector<Vec3> reached;
    if (mesh.turn) {
        for (int k = 0; k < kTurns; ++k) {
            const Eigen::AngleAxisd turn(2 * std::numbers::pi * k / kTurns, mesh.turn->axis);
            for (const Vec3& p : rest)
                reached.push_back(mesh.turn->through + turn * (p - mesh.turn->through));
        }
    } else if (mesh.path) {
        for (int k = 0; k <= kPathPlaces; ++k) {
            const double share = static_cast<double>(k) / kPathPlaces;
            const PathPose pose =
                mesh.path->at(mesh.path->first() + share * (mesh.path->last() - mesh.path->first()));
            for (const Vec3& p : rest) reached.push_back(pose.place + pose.rotation * p);
        }
    } else {
        return rest;
    }
    return outermost(reached);
}

}  // namespace

std::vector<Vec3> mesh_reach(const FilmedScene& scene) {
    std::vector<Vec3> all;
    for (const SceneMesh& mesh : scene.meshes)
        if (mesh.surface)
            for (const Vec3& point : reach_of(mesh)) all.push_back(point);
    return all;
}

}  // namespace grainreel
