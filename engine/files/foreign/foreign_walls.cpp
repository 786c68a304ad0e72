#include "engine/files/foreign/foreign_walls.hpp"

#include <fmt/format.h>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace grainreel {

namespace {

// Which part each triangle belongs to. Vertices join where they lie on one place to six digits, as text files
// have them.
std::vector<std::size_t> parts_of(const TriangleMesh& mesh) {
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (const Vec3& vertex : mesh.vertices) low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
    const double grain = std::max((high - low).maxCoeff(), 1e-300) * 1e-5;
    std::vector<std::size_t> parent(mesh.vertices.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
    std::map<Cell, std::size_t> known;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3 at = (mesh.vertices[i] - low) / grain;
        const Cell cell{std::llround(at.x()), std::llround(at.y()), std::llround(at.z())};
        const auto [found, is_new] = known.emplace(cell, i);
        if (!is_new) parent[root(i)] = root(found->second);
    }
    for (const TriangleMesh::Triangle& triangle : mesh.triangles)
        for (const std::size_t corner : {1U, 2U})
            parent[root(static_cast<std::size_t>(triangle[corner]))] =
                root(static_cast<std::size_t>(triangle[0]));
    std::map<std::size_t, std::size_t> number;
    std::vector<std::size_t> parts;
    for (const TriangleMesh::Triangle& triangle : mesh.triangles)
        parts.push_back(
            number.emplace(root(static_cast<std::size_t>(triangle[0])), number.size()).first->second);
    return parts;
}

// Corners of some triangles, three each.
std::vector<Vec3> corners_of(const TriangleMesh& mesh, const std::vector<std::size_t>& triangles,
                             double unit) {
    std::vector<Vec3> corners;
    for (const std::size_t t : triangles)
        for (const std::int32_t vertex : mesh.triangles[t])
            corners.push_back(unit * mesh.vertices[static_cast<std::size_t>(vertex)]);
    return corners;
}

TriangleMesh mesh_of(const std::vector<Vec3>& corners) {
    TriangleMesh mesh;
    mesh.vertices = corners;
    for (std::int32_t k = 0; k + 2 < static_cast<std::int32_t>(corners.size()); k += 3)
        mesh.triangles.push_back({k, k + 1, k + 2});
    return mesh;
}

RawTable rows_of(const RawTable& table, const std::vector<std::size_t>& rows) {
    RawTable some;
    some.rows = rows.size();
    for (const RawColumn& column : table.columns) {
        RawColumn& one = some.columns.emplace_back();
        one.name = column.name;
        for (const std::size_t row : rows) one.values.push_back(column.values[row]);
    }
    return some;
}

// One part of one surface through all moments.
MovingWall follow(const std::vector<WallMoment>& moments, std::size_t wall,
                  const std::vector<std::size_t>& triangles, double unit, bool& changes) {
    const RawWall& first = moments.front().walls[wall];
    const std::vector<Vec3> rest = corners_of(first.mesh, triangles, unit);
    MovingWall moving;
    moving.name = first.name;
    moving.shape = mesh_of(rest);
    Vec3 low = rest.front(), high = low;
    for (const Vec3& corner : rest) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    const double still = 1e-5 * (high - low).norm(), rigid = 1e-3 * (high - low).norm();
    for (const WallMoment& moment : moments) {
        BodyPose pose = moving.poses.empty() ? BodyPose() : moving.poses.back();
        const bool there = wall < moment.walls.size() &&
                           moment.walls[wall].mesh.triangles.size() == first.mesh.triangles.size();
        if (there) {
            const std::vector<Vec3> now = corners_of(moment.walls[wall].mesh, triangles, unit);
            double farthest = 0;
            for (std::size_t i = 0; i < now.size(); ++i)
                farthest = std::max(farthest, (now[i] - rest[i]).norm());
            if (farthest <= still) {
                pose = BodyPose();
            } else {
                const RigidMotion motion = rigid_motion(rest, now);
                if (motion.residual <= rigid) pose = motion.pose;
                changes = changes || motion.residual > rigid;
                moving.moves = true;
            }
            if (moment.walls[wall].cells.rows == first.mesh.triangles.size())
                moving.cells.push_back(rows_of(moment.walls[wall].cells, triangles));
        }
        changes = changes || !there;
        moving.poses.push_back(pose);
    }
    if (moving.cells.size() != moments.size()) moving.cells.clear();
    return moving;
}

}  // namespace

RigidMotion rigid_motion(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    RigidMotion motion;
    if (from.empty()) return motion;
    Vec3 middle(0, 0, 0), now(0, 0, 0);
    for (const Vec3& point : from) middle += point;
    for (const Vec3& point : to) now += point;
    middle /= static_cast<double>(from.size());
    now /= static_cast<double>(to.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) spread += (from[i] - middle) * (to[i] - now).transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
    mirror(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Matrix3d turn = svd.matrixV() * mirror * svd.matrixU().transpose();
    motion.pose.rotation = Quaternion(turn).normalized();
    motion.pose.place = now - motion.pose.rotation * middle;
    for (std::size_t i = 0; i < from.size(); ++i)
        motion.residual = std::max(motion.residual, (motion.pose.moved(from[i]) - to[i]).norm());
    return motion;
}

std::vector<MovingWall> follow_walls(const std::vector<WallMoment>& moments, double unit,
                                     const std::string& name, std::vector<std::string>& news) {
    std::vector<MovingWall> all;
    if (moments.empty()) return all;
    bool changes = false;
    for (std::size_t wall = 0; wall < moments.front().walls.size(); ++wall) {
        const RawWall& first = moments.front().walls[wall];
        if (first.mesh.empty()) continue;
        std::vector<std::vector<std::size_t>> parts(1);
        // Parts matter only where something moves.
        if (moments.size() > 1) {
            const std::vector<std::size_t> of = parts_of(first.mesh);
            parts.assign(1 + *std::max_element(of.begin(), of.end()), {});
            for (std::size_t t = 0; t < of.size(); ++t) parts[of[t]].push_back(t);
        } else {
            parts[0].resize(first.mesh.triangles.size());
            std::iota(parts[0].begin(), parts[0].end(), std::size_t{0});
        }
        std::vector<MovingWall> moving;
        for (const std::vector<std::size_t>& triangles : parts)
            moving.push_back(follow(moments, wall, triangles, unit, changes));
        // What stands still together is one wall again.
        const bool any =
            std::any_of(moving.begin(), moving.end(), [](const MovingWall& one) { return one.moves; });
        constexpr std::size_t most_parts = 100;
        if (!any || parts.size() > most_parts) {
            std::vector<std::size_t> whole(first.mesh.triangles.size());
            std::iota(whole.begin(), whole.end(), std::size_t{0});
            moving = {follow(moments, wall, whole, unit, changes)};
        }
        std::move(moving.begin(), moving.end(), std::back_inserter(all));
    }
    if (changes)
        news.push_back(fmt::format(
            "{}: a wall changes its shape, or is missing at times; it stays as it was before", name));
    return all;
}

}  // namespace grainreel
