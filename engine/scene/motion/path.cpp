#include "engine/scene/motion/path.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/scene/motion/path_file.hpp"

namespace grainreel {

namespace {

Quaternion quaternion_of(const Eigen::Vector4d& w_first) {
    return {w_first[0], w_first[1], w_first[2], w_first[3]};
}

// p|, q' = (p' - q (q.p')) / |p|, and the spin is 2 q' q*.|The quaternion is scaled to length 1: q = p/|p|,
// q' = (p' - q (q.p')) / |p|, and the spin is 2 q' q*.|p|, q' = (p' - q (q.p')) / |p|, and the spin is 2 q'
// q*.
Vec3 spin_of(const Eigen::Vector4d& raw, const Eigen::Vector4d& slope) {
    const double length = raw.norm();
    const Eigen::Vector4d unit = raw / length;
    const Eigen::Vector4d change = (slope - unit.dot(slope) * unit) / length;
    return 2 * (quaternion_of(change) * quaternion_of(unit).conjugate()).vec();
}

// The mesh rests until the run begins, and would be elsewhere at once.
void check_start(const MotionPath& path, const PathRows& rows, const std::filesystem::path& file) {
    constexpr double same = 1e-6;  // of the path's size; rad
    const PathPose start = path.at(0);
    Vec3 low(0, 0, 0), high(0, 0, 0);
    for (const Vec3& place : rows.places) low = low.cwiseMin(place), high = high.cwiseMax(place);
    const Vec3 place = start.place - path.pivot() + start.rotation * path.pivot();
    const bool turned = Eigen::AngleAxisd(start.rotation).angle() > same;
    if (place.norm() <= same * (high - low).norm() && !turned) return;
    throw UserError(fmt::format(
        "{}: at 0 s the path is at ({:.6g}, {:.6g}, {:.6g}) m{}, but places count from where the mesh rests, "
        "and it rests until then; {}",
        file.string(), place.x(), place.y(), place.z(), turned ? ", turned" : "",
        turned
            ? "let the path begin at 0, 0, 0 with the quaternion 1, 0, 0, 0, and place the mesh by position "
              "and rotation"
            : "subtract that from all rows, and add it to the mesh's position"));
}

}  // namespace

std::shared_ptr<const MotionPath> MotionPath::read(const std::filesystem::path& file, const Vec3& pivot) {
    const PathRows rows = read_path_rows(file);
    auto path = std::make_shared<MotionPath>();
    path->times_ = rows.times;
    path->pieces_ = natural_spline(rows.times, rows.places);
    if (!rows.turns.empty()) path->turns_ = natural_spline(rows.times, rows.turns);
    path->pivot_ = pivot;
    path->hash_ = hash_of_file(file);
    path->find_tops();
    check_start(*path, rows, file);
    return path;
}

MotionPath::Moment MotionPath::moment_at(double time) const {
    if (time < first()) return {0, 0, true};
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    if (after == times_.end()) return {pieces_.size() - 1, last() - times_[times_.size() - 2], time > last()};
    const auto piece = static_cast<std::size_t>(after - times_.begin()) - 1;
    return {piece, time - times_[piece], false};
}

// The pivot goes along the path, and all else turns about it.
PathPose MotionPath::at(double time) const {
    const Moment moment = moment_at(time);
    const CubicPiece<Vec3>& piece = pieces_[moment.piece];
    PathPose pose;
    pose.place = piece.value(moment.since);
    if (!moment.still) pose.velocity = piece.slope(moment.since);
    if (turns_.empty()) return pose;
    const CubicPiece<Eigen::Vector4d>& turning = turns_[moment.piece];
    const Eigen::Vector4d raw = turning.value(moment.since);
    pose.rotation = quaternion_of(raw.normalized());
    if (!moment.still) pose.spin = spin_of(raw, turning.slope(moment.since));
    const Vec3 arm = pose.rotation * pivot_;
    pose.place += pivot_ - arm;
    pose.velocity -= pose.spin.cross(arm);
    return pose;
}

void MotionPath::find_tops() {
    constexpr int kTimes = 16;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const double width = times_[i + 1] - times_[i];
        for (int k = 0; k <= kTimes; ++k) {
            const double since = width * k / kTimes;
            top_speed_ = std::max(top_speed_, pieces_[i].slope(since).norm());
            if (!turns_.empty())
                top_spin_ =
                    std::max(top_spin_, spin_of(turns_[i].value(since), turns_[i].slope(since)).norm());
        }
    }
}

}  // namespace grainreel
