#include "engine/step/step_loop.hpp"

#include <algorithm>
#include <cmath>

#include "engine/step/integrate.hpp"

namespace grainreel {

StepLoop::StepLoop(const Plan& plan, const Surroundings& surroundings, Grains& grains, Team& team)
    : around_(surroundings),
      grains_(grains),
      team_(team),
      rules_(plan, surroundings.period),
      members_(team.size()) {}

void StepLoop::restart() {
    const Pose rest = around_.motion.at(-1);
    for (Member& m : members_) {
        m.contacts = {};
        m.reach = {};
        m.fastest.setZero();
    }
    team_.run([&](int member) {
        members_[member].walls.set(around_.faces, rest, rest, 0);
        rebuild(member, rest);
        // The first half kick wants the forces of where the grains are now: a step of no length gives them.
        for (std::int32_t i = share_[member]; i < share_[member + 1]; ++i) grains_.load[i] = {};
        members_[member].contacts.compute(rules_, grains_, members_[member].walls, 0);
    });
    rebuilds_ = refreshes_ = 0;
    fresh_ = true;
}

void StepLoop::run(std::int64_t from, std::int64_t count, double step, double drag) {
    if (count <= 0) return;
    if (fresh_) listed_step_ = from;
    fresh_ = false;
    KickInput kicks{around_.gravity, step, rules_.rubs, Vec3::Zero(), 1};
    if (drag > 0) kicks.keep = std::exp(-drag * step);
    team_.run([&](int member) { run_member(member, from, from + count, kicks); });
}

// Steps `from` to `to`, the part of one thread. A thread writes to its own grains only; it reads the others'
// positions and velocities between the two barriers of a step, while nobody writes them.
void StepLoop::run_member(int member, std::int64_t from, std::int64_t to, KickInput kicks) {
    Member& mine = members_[member];
    for (std::int64_t n = from; n < to; ++n) {
        kicks.frame =
            (drift_since_listing(n + 1, kicks.step) - drift_since_listing(n, kicks.step)) / kicks.step;
        const std::int32_t begin = share_[member], end = share_[member + 1];
        mine.fastest = n == from ? kick_and_drift(grains_, kicks, begin, end)
                                 : kick_and_go_on(grains_, kicks, begin, end);
        const Pose now = around_.motion.at(n + 1);
        mine.walls.set(around_.faces, around_.motion.at(n), now, kicks.step);
        team_.barrier();
        renew_contacts(member, n + 1, now, kicks);
        mine.contacts.compute(rules_, grains_, mine.walls, kicks.step);
        team_.barrier();
    }
    kick(grains_, kicks, share_[member], share_[member + 1]);
}

// Lists that no longer reach far enough at step n are made again.
void StepLoop::renew_contacts(int member, std::int64_t n, const Pose& now, const KickInput& kicks) {
    Member& mine = members_[member];
    const Vec3 drift = drift_since_listing(n, kicks.step);
    if (!contacts_expired(mine, now, drift, kicks.step)) return;
    set_reach(mine, now, drift, kicks.frame, kicks.step);
    mine.farthest = farthest_of(share_[member], share_[member + 1], drift);
    team_.barrier();
    if (lists_expired(mine, now, drift)) {
        rebuild(member, now);
        if (member == 0) listed_step_ = n;
        mine.reach.drift.setZero();
    } else {
        refresh(member, true);
    }
    if (member == 0) ++refreshes_;
}

// How far the bed as a whole has flown since the lists were made, were it in free flight. Displacements
// count against this: it takes nothing from the safety of the lists, whatever the bed does, because two
// grains come closer by at most the sum of what each moves against any common frame.
Vec3 StepLoop::drift_since_listing(std::int64_t n, double step) const {
    const double time = static_cast<double>(n - listed_step_) * step;
    return time * (listed_velocity_ + 0.5 * time * around_.gravity);
}

namespace {

// m: how far any face has gone between two poses, against a frame that has gone by `flown`.
double farthest_face(const std::vector<Face>& faces, const Pose& before, const Pose& now, const Vec3& flown) {
    double squared = 0;
    for (const Face& face : faces) {
        const Vec3 gone = face.displacement(now) - face.displacement(before) - flown;
        squared = std::max(squared, gone.squaredNorm());
    }
    return std::sqrt(squared);
}

}  // namespace

// All threads come to the same answer: they add up the same numbers.
bool StepLoop::contacts_expired(Member& mine, const Pose& now, const Vec3& drift, double step) const {
    Reach& reach = mine.reach;
    Vec3 largest(0, 0, 0);  // the diagonal is the same however the grains are shared out
    for (const Member& m : members_) largest = largest.cwiseMax(m.fastest);
    reach.fastest = largest.norm();
    reach.moved += reach.fastest * step;
    const Vec3 flown = drift - reach.drift;
    return 2 * reach.moved > reach.skin ||
           reach.moved + farthest_face(around_.faces, reach.pose, now, flown) > reach.skin;
}

bool StepLoop::lists_expired(const Member& mine, const Pose& now, const Vec3& drift) const {
    double moved = 0;
    for (const Member& m : members_) moved = std::max(moved, m.farthest);
    const double used = moved + std::max(moved, farthest_face(around_.faces, listed_pose_, now, drift));
    return used + mine.reach.skin > around_.skin;
}

double StepLoop::farthest_of(std::int32_t begin, std::int32_t end, const Vec3& drift) const {
    double squared = 0;
    for (std::int32_t i = begin; i < end; ++i) {
        squared = std::max(squared, (grains_.place[i].position - listed_at_[i] - drift).squaredNorm());
    }
    return std::sqrt(squared);
}

// The contact lists are to last for about kStepsPerRefresh steps at the speeds of now.
void StepLoop::set_reach(Member& mine, const Pose& now, const Vec3& drift, const Vec3& frame,
                         double step) const {
    constexpr double kStepsPerRefresh = 16, kLeastShare = 1e-3, kMostShare = 0.4;
    Reach& reach = mine.reach;
    double wall = 0;
    for (const Face& face : around_.faces) wall = std::max(wall, (face.velocity_at(now) - frame).norm());
    const double wanted = kStepsPerRefresh * step * (reach.fastest + std::max(reach.fastest, wall));
    reach.skin = std::clamp(wanted, kLeastShare * around_.skin, kMostShare * around_.skin);
    reach.moved = 0;
    reach.drift = drift;
    reach.pose = now;
}

}  // namespace grainreel
