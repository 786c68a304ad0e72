// Walls of another program's run. The first half follows surfaces from moment to moment; the second is the
// part of ForeignArchive that reads the files of walls and finds the pose of each wall at each moment of the
// grains.
#include "engine/files/foreign/foreign_archive.hpp"

#include <fmt/format.h>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "engine/base/error.hpp"
#include "engine/files/damage.hpp"

namespace grainreel {

namespace {

// The number of the connected part that each triangle belongs to. Vertices are the same if their places agree
// to six digits, which is what text files have.
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
        const Vec3 scaled = (mesh.vertices[i] - low) / grain;
        const Cell cell{std::llround(scaled.x()), std::llround(scaled.y()), std::llround(scaled.z())};
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

// The corners of some triangles, three for each.
std::vector<Vec3> corners_of(const TriangleMesh& mesh, const std::vector<std::size_t>& triangles,
                             double unit) {
    std::vector<Vec3> corners;
    for (const std::size_t t : triangles)
        for (const std::int32_t vertex : mesh.triangles[t]) corners.push_back(unit * mesh.vertices[vertex]);
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

// Follows one part of one surface through all moments.
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
        const bool same_shape = wall < moment.walls.size() &&
                                moment.walls[wall].mesh.triangles.size() == first.mesh.triangles.size();
        if (same_shape) {
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
        changes = changes || !same_shape;
        moving.poses.push_back(pose);
    }
    if (moving.cells.size() != moments.size()) moving.cells.clear();
    return moving;
}

// Refuses corners of walls that are farther than a bed can reach, because a damaged file has them.
void check_corners(const std::vector<WallMoment>& moments, double unit, const std::string& name) {
    for (const WallMoment& moment : moments)
        for (const RawWall& wall : moment.walls)
            for (const Vec3& corner : wall.mesh.vertices)
                if (!(corner.cwiseAbs().maxCoeff() * unit <= kFarthestPlace))
                    throw UserError(
                        "{}: a wall has a corner at ({:.3g}, {:.3g}, {:.3g}) m, where no wall "
                        "is; is the file "
                        "damaged, or is its unit another (--walls-scale)?",
                        name, unit * corner.x(), unit * corner.y(), unit * corner.z());
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
    check_corners(moments, unit, name);
    bool changes = false;
    for (std::size_t wall = 0; wall < moments.front().walls.size(); ++wall) {
        const RawWall& first = moments.front().walls[wall];
        if (first.mesh.empty()) continue;
        std::vector<std::vector<std::size_t>> parts(1);
        // Parts matter only if something can move.
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
        // If no part moves, the parts are one wall again.
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

// Adds the sides and the floor of a box that is not periodic as walls, if no others are known.
void ForeignArchive::add_box() {
    if (!walls_.empty() || !world_.cell || !options_.container.empty()) return;
    const WorldCell& cell = *world_.cell;
    const auto solid = [&](std::size_t axis) { return !cell.periodic[axis] && cell.edges[axis].norm() > 0; };
    TriangleMesh mesh;
    const auto face = [&](const Vec3& corner, const Vec3& a, const Vec3& b) {
        const auto first = static_cast<std::int32_t>(mesh.vertices.size());
        for (const Vec3& vertex : {corner, Vec3(corner + a), Vec3(corner + a + b), Vec3(corner + b)})
            mesh.vertices.push_back(vertex);
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    };
    const auto& [x, y, z] = cell.edges;
    if (!solid(2) || x.norm() == 0 || y.norm() == 0) return;
    face(cell.origin, x, y);
    if (solid(0)) face(cell.origin, y, z), face(cell.origin + x, z, y);
    if (solid(1)) face(cell.origin, z, x), face(cell.origin + y, x, z);
    MovingWall box;
    box.name = "box";
    box.shape = mesh;
    box.poses = {BodyPose()};
    box.is_box = true;
    walls_.push_back(std::move(box));
    wall_moments_ = {WallMoment()};
}

bool ForeignArchive::in_frames() const {
    return std::any_of(grains_->moments().begin(), grains_->moments().end(),
                       [](const RawMoment& one) { return one.has_walls; });
}

bool ForeignArchive::walls_come() const {
    return in_frames() || std::any_of(wall_files_.begin(), wall_files_.end(),
                                      [](const auto& files) { return files.size() > 1; });
}

namespace {

// The name of a series of files without its number: "walls" of walls_2000.vtk.
std::string name_of_series(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    const std::size_t end = stem.find_last_not_of("0123456789._- ");
    return end == std::string::npos ? stem : stem.substr(0, end + 1);
}

}  // namespace

void ForeignArchive::read_walls() {
    const double unit = options_.walls_scale.value_or(meaning_->units().length);
    walls_.clear();
    wall_moments_.clear();
    if (in_frames()) {
        for (std::size_t k = 0; k < moments_.size(); ++k)
            wall_moments_.push_back({raw_steps_[k], moments_[k].time, raw(k).walls});
        while (!wall_moments_.empty() && wall_moments_.front().walls.empty())
            wall_moments_.erase(wall_moments_.begin());
        walls_ = follow_walls(wall_moments_, unit, path_.string(), news_);
    }
    // A series of one file stands still, and all others must have the same moments.
    for (const std::vector<std::filesystem::path>& files : wall_files_) {
        const RawSeries series(files);
        std::vector<WallMoment> moments;
        for (std::size_t k = 0; k < series.moments().size(); ++k) {
            RawFrame frame = series.read(k);
            moments.push_back({frame.step, frame.time, std::move(frame.walls)});
        }
        std::vector<MovingWall> more = follow_walls(moments, unit, files.front().string(), news_);
        for (MovingWall& wall : more)
            if (wall.name.empty() || wall.name == files.front().stem())
                wall.name = name_of_series(files.front());
        if (moments.size() > wall_moments_.size()) wall_moments_ = std::move(moments);
        std::move(more.begin(), more.end(), std::back_inserter(walls_));
    }
}

// Changes a wall's shape and poses so that its place at rest is where it was at the first moment of the
// grains.
void ForeignArchive::rest_at_first(MovingWall& wall, std::size_t first) {
    const BodyPose rest = wall.poses[first];
    for (Vec3& vertex : wall.shape.vertices) vertex = rest.moved(vertex);
    for (BodyPose& pose : wall.poses) {
        pose.rotation = pose.rotation * rest.rotation.conjugate();
        pose.place -= pose.rotation * rest.place;
    }
}

// Finds the pose of each wall at each moment: the last one that is not later, by step or by time.
void ForeignArchive::match_walls() {
    wall_at_.clear();
    for (std::size_t k = 0; k < moments_.size(); ++k) {
        std::vector<std::size_t> at;
        for (const MovingWall& wall : walls_) {
            std::size_t pose = 0;
            for (std::size_t m = 1; m < std::min(wall.poses.size(), wall_moments_.size()); ++m) {
                const WallMoment& moment = wall_moments_[m];
                const bool reached = moment.step   ? *moment.step <= raw_steps_[k]
                                     : moment.time ? *moment.time <= moments_[k].time * (1 + 1e-9)
                                                   : m <= k;
                if (reached) pose = m;
            }
            at.push_back(pose);
        }
        if (k == 0)
            for (std::size_t w = 0; w < walls_.size(); ++w) rest_at_first(walls_[w], at[w]);
        wall_at_.push_back(std::move(at));
        State& moment = moments_[k];
        moment.bodies.resize(kFirstPlaneBody + walls_.size());
        for (std::size_t w = 0; w < walls_.size(); ++w)
            moment.bodies[kFirstPlaneBody + w] = walls_[w].poses[wall_at_[k][w]];
    }
}

const RawTable* ForeignArchive::wall_cells(std::size_t index, std::size_t wall) const {
    const std::vector<RawTable>& cells = walls_.at(wall).cells;
    const std::size_t place = wall_at_.at(index).at(wall);
    return place < cells.size() ? &cells[place] : nullptr;
}

}  // namespace grainreel
