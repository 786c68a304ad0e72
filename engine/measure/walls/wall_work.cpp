#include "engine/measure/walls/wall_work.hpp"

#include <algorithm>
#include <cmath>

#include "engine/state/wall_motion.hpp"

namespace grainreel {
namespace {

constexpr double kLooksAPeriod = 128, kLooksARow = 64;

// Whether its velocity changes, or its rate.
bool is_unsteady(const Body& body, const Drive& drive) {
    const bool ramps =
        body.turn && (body.turn->from > 0 || body.turn->over > 0 || std::isfinite(body.turn->until));
    return (body.driven && drive.present) || body.path || ramps;
}

// In counts. What was counted is subtracted as whole numbers, so that nothing is lost late in a run.
using Three = std::array<WideInt, 3>;
Vec3 sum(const Three& then, const Three& now, double felt, const Three& last_then, const Three& last_now) {
    Vec3 counts;
    for (int a = 0; a < 3; ++a)
        counts[a] =
            static_cast<double>(now[a] - then[a]) + felt * static_cast<double>(last_now[a] - last_then[a]);
    return counts;
}

std::vector<double> angles_at(const std::vector<Body>& bodies, double time) {
    std::vector<double> angles;
    for (const Body& body : bodies) angles.push_back(body.turn ? body.turn->angle_at(time) : 0);
    return angles;
}

}  // namespace

WallSum sum_between(const FaceSums& then, const FaceSums& now, const WallSums& sums) {
    const WallScale& unit = sums.scale;
    return {sum(then.force, now.force, sums.felt, then.last_force, now.last_force) * unit.force,
            sum(then.moment, now.moment, sums.felt, then.last_moment, now.last_moment) * unit.force *
                unit.length};
}

WallWork::WallWork(const Scene& scene, const Plan& plan)
    : walls_(wall_bodies(scene)), bodies_(bodies_of(scene)) {
    bool unsteady = false;
    for (const WallBody& wall : walls_)
        if (!wall.fixed) any_ = true, unsteady |= is_unsteady(bodies_[wall.body], scene.drive);
    if (!unsteady) return;
    double every = plan.measures_every / kLooksARow;
    if (const auto period = static_cast<double>(plan.clock.steps_per_period); period > 0)
        every = every > 0 ? std::min(every, period / kLooksAPeriod) : period / kLooksAPeriod;
    every_ = std::max<std::int64_t>(1, std::llround(every));
}

std::int64_t WallWork::gathers_after(std::int64_t step) const {
    return every_ > 0 ? (step + every_) / every_ * every_ : Observer::kNever;
}

void WallWork::start(const Moment& m) {
    if (!any_) return;
    work_.assign(walls_.size(), 0);
    step_ = m.step;
    sums_ = m.wall_sums->faces;
    poses_ = poses_of(bodies_, m.pose);
    turned_ = angles_at(bodies_, m.pose.time);
}

void WallWork::gather(const Moment& m) {
    if (!any_ || m.step <= step_) return;
    std::vector<double> work = until(m);
    start(m);
    work_ = std::move(work);
}

std::vector<double> WallWork::until(const Moment& m) const {
    std::vector<double> work = work_;
    if (!any_ || m.step <= step_) return work;
    const std::vector<double> turned = angles_at(bodies_, m.pose.time);
    const double length = m.clock.step, time = length * static_cast<double>(m.step - step_);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const WallBody& wall = walls_[w];
        if (wall.fixed) continue;
        const BodyPose now = bodies_[wall.body].at(m.pose);
        const Vec3 way = now.moved(wall.point) - poses_[wall.body].moved(wall.point);
        const Vec3 spin = wall.turns ? Vec3((turned[wall.body] - turned_[wall.body]) / time * wall.axis)
                                     : Vec3(0.5 * (now.spin + poses_[wall.body].spin));
        const WallSum on_wall = sum_between(sums_[w], m.wall_sums->faces[w], *m.wall_sums);
        work[w] -= length * (on_wall.force.dot(way) / time + on_wall.moment.dot(spin));
    }
    return work;
}

void WallWork::save(std::ostream& out) const {
    if (!any_) return;
    const Writing each{out};
    each(step_), each(sums_), each(work_);
}

void WallWork::load(const Moment& m, Bytes& in) {
    if (!any_) return;
    const Reading each{in};
    each(step_), each(sums_), each(work_);
    const bool finite = std::all_of(work_.begin(), work_.end(), [](double w) { return std::isfinite(w); });
    if (step_ < 0 || step_ > m.step || sums_.size() != walls_.size() || work_.size() != walls_.size() ||
        !are_sound(sums_) || !finite)
        return in.fail();
    const Pose drive = WallMotion(m.scene.drive, m.clock).at(step_);
    poses_ = poses_of(bodies_, drive);
    turned_ = angles_at(bodies_, drive.time);
}

}  // namespace grainreel
