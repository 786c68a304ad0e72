#include "engine/step/lists/list_life.hpp"

#include <algorithm>
#include <cmath>

#include "engine/mesh/surface.hpp"
#include "engine/step/lists/expiry.hpp"

namespace grainreel {

ListLife::ListLife(const Surroundings& around, int threads)
    : around_(around), ways_(around), threads_(threads), skin_(around.skin), next_skin_(around.skin) {}

void ListLife::restart() {
    skin_ = around_.skin;
    listed_at_.clear();
    for (Thread& thread : threads_) thread.reach = {};
}

// Lists that lasted too few steps get a wider skin. Lists that lasted very long get a narrower one, because a
// wide skin lists many pairs in vain. If the bed is periodic along x, the skin stays: with a wider one a pair
// could be near both directly and across the boundary, and be listed twice.
void ListLife::set_next_skin(double lasted) {
    constexpr double kShort = 400, kLong = 1500;  // steps
    constexpr double kFactor = 1.25;
    next_skin_ = skin_;
    if (around_.period > 0) return;
    const double factor = lasted < kShort ? kFactor : lasted > kLong ? 1 / kFactor : 1;
    next_skin_ = std::clamp(factor * skin_, kLeastSkin * around_.skin, kMostSkin * around_.skin);
}

void ListLife::note_listing(const Grains& grains, const DrivePose& pose, double time) {
    listed_at_.resize(grains.size());
    listed_velocity_.setZero();
    for (std::size_t i = 0; i < grains.size(); ++i) {
        listed_at_[i] = grains.place[i].position.cast<float>();
        listed_velocity_ += grains.motion[i].velocity;
    }
    listed_velocity_ /= static_cast<double>(grains.size());
    listed_pose_ = pose;
    listed_step_ = time;
}

double ListLife::lasted(double time) const {
    const bool some_are_new = farthest() > kNowhere / 2;
    return some_are_new ? kLastsWell : time - listed_step_;
}

Vec3 ListLife::drift(double time, double step) const {
    const double passed = (time - listed_step_) * step;
    return passed * (listed_velocity_ + 0.5 * passed * around_.gravity);
}

Vec3 ListLife::frame(const Evaluation& at, double step) const {
    const double last = at.time - at.since / step;
    return (drift(at.time, step) - drift(last, step)) / at.since;
}

double ListLife::wall_way(int thread, const Evaluation& at, const Vec3& drift) const {
    const Reach& reach = threads_[thread].reach;
    return ways_.farthest(reach.pose, at.now, drift - reach.drift);
}

bool ListLife::contacts_expired(int thread, const Vec3& fastest, std::int64_t parted, std::int64_t grains,
                                const Evaluation& at, const Vec3& drift) {
    Reach& reach = threads_[thread].reach;
    UsedUp used{reach.moved, reach.fastest, reach.parted};
    use_up(used, fastest.x(), fastest.y(), fastest.z(), parted, at.since);
    reach.moved = used.moved, reach.fastest = used.fastest, reach.parted = used.parted;
    return are_used_up(used, reach.skin, wall_way(thread, at, drift), grains);
}

void ListLife::set_reach(int thread, const DrivePose& now, const Vec3& drift, const Vec3& frame,
                         double step) {
    constexpr double kStepsPerRefresh = 48, kLeastShare = 1e-3, kMostShare = 0.4;
    Reach& reach = threads_[thread].reach;
    const double wall = ways_.fastest(now, frame);
    const double wanted = kStepsPerRefresh * step * (reach.fastest + std::max(reach.fastest, wall));
    reach.skin = std::clamp(wanted, kLeastShare * skin_, kMostShare * skin_);
    reach.moved = 0;
    reach.parted = 0;
    reach.drift = drift;
    reach.pose = now;
}

void ListLife::measure(int thread, const Grains& grains, std::int32_t begin, std::int32_t end,
                       const Vec3& drift) {
    constexpr double kRounding = 1e-7;  // relative rounding of floats
    double farthest = 0;
    for (std::int32_t i = begin; i < end; ++i) {
        const Vec3 listed = listed_at_[i].cast<double>();
        const double moved = (grains.place[i].position - listed - drift).norm();
        farthest = std::max(farthest, moved + kRounding * listed.norm());
    }
    threads_[thread].farthest = farthest;
}

bool ListLife::lists_expired(int thread, const DrivePose& now, const Vec3& drift) const {
    const double moved = farthest();
    const double used = moved + std::max(moved, ways_.farthest(listed_pose_, now, drift));
    return used + threads_[thread].reach.skin > skin_;
}

double ListLife::farthest() const {
    double moved = 0;
    for (const Thread& thread : threads_) moved = std::max(moved, thread.farthest);
    return moved;
}

void ListLife::leave_out(const std::vector<std::int32_t>& index) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < index.size(); ++i)
        if (index[i] >= 0) listed_at_[kept++] = listed_at_[i];
    listed_at_.resize(kept);
}

void ListLife::add_unlisted() {
    listed_at_.push_back(Eigen::Vector3f::Constant(kNowhere));
    for (Thread& thread : threads_) thread.reach.moved = kNowhere;
}

namespace {

bool is_finite(const DrivePose& pose) {
    return pose.offset.allFinite() && pose.velocity.allFinite() && std::isfinite(pose.time);
}

}  // namespace

bool ListLife::is_sound(std::int32_t grains, const Reach& reach) const {
    const auto finite = [](const auto& v) { return v.allFinite(); };
    return std::ssize(listed_at_) == grains && std::isfinite(listed_step_) && is_finite(listed_pose_) &&
           listed_velocity_.allFinite() && skin_ >= kLeastSkin * around_.skin &&
           skin_ <= kMostSkin * around_.skin && reach.skin >= 0 && reach.skin <= skin_ && reach.moved >= 0 &&
           std::isfinite(reach.moved) && std::isfinite(reach.fastest) && reach.parted >= 0 &&
           reach.drift.allFinite() && is_finite(reach.pose) &&
           std::all_of(listed_at_.begin(), listed_at_.end(), finite);
}

namespace {

bool are_parallel(const Vec3& a, const Vec3& b) {
    return a.cross(b).squaredNorm() < 1e-24;
}

// Largest displacement (m) of a body's points relative to a frame displaced by `flown`. A turn moves a point
// by 2 sin(angle / 2) times its distance from the axis.
double way_of(const Body& body, const Vec3& centre, double radius, const DrivePose& before,
              const DrivePose& now, const Vec3& flown) {
    const BodyPose was = body.at(before), is = body.at(now);
    const Vec3 gone = is.moved(centre) - was.moved(centre) - flown;
    const double turned = 2 * (is.rotation * was.rotation.conjugate()).vec().norm();
    return gone.norm() + turned * radius;
}

double speed_of(const Body& body, const Vec3& centre, double radius, const DrivePose& now,
                const Vec3& frame) {
    const BodyPose is = body.at(now);
    return (is.velocity_at(is.moved(centre)) - frame).norm() + is.spin.norm() * radius;
}

}  // namespace

WallWays::WallWays(const Surroundings& around) : around_(around) {
    for (const MeshWall& mesh : around.meshes) of_meshes_.push_back(swing_of(mesh));
}

// A plane perpendicular to the axis, and a cylinder about it, stay where they are as they turn.
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

double WallWays::farthest(const DrivePose& before, const DrivePose& now, const Vec3& flown) const {
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

double WallWays::fastest(const DrivePose& now, const Vec3& frame) const {
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
