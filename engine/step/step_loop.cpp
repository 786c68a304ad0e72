#include "engine/step/step_loop.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/flush_denormals.hpp"
#include "engine/step/forces/integrate.hpp"

namespace grainreel {

StepLoop::StepLoop(const Plan& plan, const Surroundings& surroundings, Grains& grains, Team& team)
    : around_(surroundings),
      grains_(grains),
      team_(team),
      rules_(plan, surroundings.period),
      scheme_(scheme_of(plan.integrator)),
      members_(team.size()),
      skin_(surroundings.skin),
      next_skin_(surroundings.skin) {}

void StepLoop::restart() {
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    fresh_ = true;
    if (grains_.size() == 0) return begin_empty();
    const Pose rest = around_.motion.at(-1);
    CostClock idle;
    skin_ = around_.skin;
    for (Member& m : members_) {
        m.contacts = {};
        m.reach = {};
        m.fastest.setZero();
    }
    team_.run([&](int member) {
        members_[member].walls.set(around_.faces, rest, rest, 0);
        rebuild(member, rest, 0, kLastsWell);
        // The first half kick needs the forces at the present positions. A step of length zero computes them.
        round_motion(grains_, {}, share_[member], share_[member + 1]);
        for (std::int32_t i = share_[member]; i < share_[member + 1]; ++i) grains_.load[i] = {};
        copy_foreign(member);
        Vanguard none;
        members_[member].contacts.compute(rules_, grains_, members_[member].walls, {0, 0, 0, 0, 0}, none,
                                          idle);
    });
    rebuilds_ = refreshes_ = 0;
}

// Makes empty lists, for a loop that has no grains yet.
void StepLoop::begin_empty() {
    lists_ = {};
    lists_.pairs.resize(0, 0);
    listed_at_.clear();
    share_.assign(team_.size() + 1, 0);
    skin_ = around_.skin;
    for (Member& m : members_) {
        m.contacts = {};
        m.reach = {};
        m.contacts.own(rules_, lists_, 0, 0);
    }
    rebuilds_ = refreshes_ = 0;
}

void StepLoop::run(std::int64_t from, std::int64_t count, double step, double drag) {
    const std::int64_t to = from + count;
    while (from < to && grains_.size() > 0) {
        from = run_until_one_may_leave(from, to, step, drag);
        if (!around_.exits.empty()) let_leave(from);
    }
}

// Runs until step `to`, or until the end of a step in which a grain may leave. Returns the step reached.
std::int64_t StepLoop::run_until_one_may_leave(std::int64_t from, std::int64_t to, double step, double drag) {
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    KickInput kicks{around_.gravity, rules_.rubs};
    if (fresh_) {
        listed_step_ = static_cast<double>(from);
        first_step_ = from;
        if (scheme_.corrects) begin_derivatives(grains_, kicks);
    }
    fresh_ = false;
    if (drag > 0) kicks.keep = std::exp(-drag * step / static_cast<double>(scheme_.stages.size()));
    const auto work = [&](int member) { run_member(member, from, to, step, kicks); };
    team_.run(std::ref(work));  // by reference: no copy on the heap
    first_step_ = kGoesOn;
    return members_[0].reached;
}

// One thread's part of the steps `from` to `to`. It stops earlier where a grain may leave. A thread reads and
// writes its own grains only. Of other threads' grains it reads copies, which exchange() brings.
//
// From here to the formula of a contact law: evaluate() -> ContactPass::compute() -> compute_stretch() ->
// compute_chunk() -> the law's kernel (docs/architecture.md, "One step").
void StepLoop::run_member(int member, std::int64_t from, std::int64_t to, double step, KickInput kicks) {
    const FlushDenormals flush;
    Member& mine = members_[member];
    mine.clock.start();
    std::int64_t n = from;
    std::size_t stage = 0;
    Evaluation at = evaluation(n, stage, step);
    kicks.loaded = &mine.contacts.loaded();
    kicks = kicks_before(at, stage, true, step, kicks);
    copy_foreign(member);
    for (bool first = true; n < to; first = false) {
        move(member, first, kicks);
        const bool last = stage + 1 == scheme_.stages.size();
        mine.may_leave = last && may_leave(member);
        begin_evaluation(member, first, at, step, kicks);
        const Evaluation now = at;
        if (++stage == scheme_.stages.size()) stage = 0, ++n;
        if (last && anyone_may_leave(mine)) to = n;
        if (n < to) {
            at = evaluation(n, stage, step);
            kicks = kicks_before(at, stage, false, step, kicks);
        }
        send_ahead(member, n < to, kicks);
        evaluate(member, now);
    }
    end_run(member, step, kicks);
    mine.reached = n;
    mine.clock.lap(Cost::integrate);
}

StepLoop::Evaluation StepLoop::evaluation(std::int64_t n, std::size_t stage, double step) const {
    double share = 0, all = 0, before = 0;
    for (std::size_t s = 0; s < scheme_.stages.size(); ++s) {
        if (s < stage) before += scheme_.stages[s].drift;
        if (s <= stage) share += scheme_.stages[s].drift;
        all += scheme_.stages[s].drift;
    }
    Evaluation at;
    at.time = static_cast<double>(n) + share;
    at.acts = step * scheme_.acts(stage);
    at.now = around_.motion.at(n, share);
    const bool goes_on = stage == 0 && n != first_step_;  // the last forces were those of another step
    at.before = goes_on ? around_.motion.at(n - 1, all) : around_.motion.at(n, before);
    at.since = step * (scheme_.stages[stage].drift + (goes_on ? scheme_.closing_drift : 0));
    return at;
}

void StepLoop::time_costs(bool on) {
    for (Member& m : members_) m.clock.turn(on);
}

void StepLoop::clear_costs() {
    for (Member& m : members_) m.clock.clear();
}

std::array<double, kCosts> StepLoop::cost_shares() const {
    std::array<double, kCosts> shares{};
    double all = 0;
    for (const Member& m : members_) {
        for (int s = 0; s < kCosts; ++s) shares[s] += m.clock.spent()[s], all += m.clock.spent()[s];
    }
    for (double& share : shares) share /= all;
    return shares;
}

// The kicks and the drift from the last forces to the next ones, which are computed at `at`. In the first
// step of a run the closing drift of the last step is left out, because the last run has made it already.
KickInput StepLoop::kicks_before(const Evaluation& at, std::size_t stage, bool first, double step,
                                 KickInput kicks) const {
    const double last = at.time - at.since / step;
    const std::size_t stage_before = stage == 0 ? scheme_.stages.size() - 1 : stage - 1;
    kicks.frame = (drift_since_listing(at.time, step) - drift_since_listing(last, step)) / at.since;
    kicks.end_kick = step * scheme_.stages[stage_before].kick;
    kicks.begin_kick = stage == 0 ? step * scheme_.opening_kick : 0;
    kicks.drift = step * scheme_.stages[stage].drift;
    if (stage == 0 && !first && !scheme_.corrects) kicks.drift += step * scheme_.closing_drift;
    return kicks;
}

void StepLoop::move(int member, bool first, const KickInput& kicks) {
    Member& mine = members_[member];
    const std::int32_t begin = share_[member], end = share_[member + 1];
    if (scheme_.corrects) {
        if (!first) correct(grains_, kicks, begin, end);
        mine.fastest = predict(grains_, kicks, begin, end);
    } else if (first) {
        mine.fastest = kick_and_drift(grains_, kicks, begin, end);
    } else {
        const Vec3 behind = kick_and_go_on(grains_, kicks, mine.ahead.next, end);
        mine.fastest = mine.ahead.fastest.cwiseMax(behind);
    }
}

// Allows the grains to begin the next step as soon as their loads are complete.
void StepLoop::send_ahead(int member, bool goes_on, const KickInput& kicks) {
    const std::int32_t begin = share_[member], end = share_[member + 1];
    Vanguard& ahead = members_[member].ahead;
    ahead = {begin, goes_on && !scheme_.corrects ? end : begin, kicks};
    ahead.next = ahead.begin;
}

// Copies the grains of other threads as they are now. No thread may move a grain meanwhile, so barriers stand
// before and after.
void StepLoop::copy_foreign(int member) {
    if (team_.size() == 1) return;
    team_.barrier(member);
    members_[member].contacts.halo().copy(grains_);
    team_.barrier(member);
}

// Exchanges grains with the other threads, once a step. This is the only place in a step where threads wait
// for each other, unless lists are made.
void StepLoop::exchange(int member, const Flight& flight) {
    Member& mine = members_[member];
    mine.box = 1 - mine.box;
    mine.told[mine.box] = {mine.fastest, mine.contacts.parted(), mine.may_leave};
    const Loaded* const loaded = scheme_.corrects ? nullptr : &mine.contacts.loaded();
    for (int other = 0; other < team_.size(); ++other)
        if (other != member) members_[other].contacts.halo().put(grains_, loaded, member, mine.box);
    team_.barrier(member);
    mine.contacts.halo().get(grains_, mine.box, flight);
}

// Before the forces: sets the walls, exchanges grains with the other threads, and renews lists if needed.
void StepLoop::begin_evaluation(int member, bool first, const Evaluation& at, double step,
                                const KickInput& kicks) {
    Member& mine = members_[member];
    mine.clock.lap(Cost::integrate);
    mine.walls.set(around_.faces, at.before, at.now, at.since);
    exchange(member, {kicks, first});
    mine.clock.lap(Cost::other);
    renew_contacts(member, at, step, kicks);
    mine.clock.lap(Cost::neighbours);
}

void StepLoop::evaluate(int member, const Evaluation& at) {
    Member& mine = members_[member];
    mine.contacts.compute(
        rules_, grains_, mine.walls,
        {at.since, scheme_.ahead, at.acts, scheme_.corrects ? 0 : at.since, mine.reach.moved}, mine.ahead,
        mine.clock);
}

void StepLoop::end_run(int member, double step, KickInput kicks) {
    const std::int32_t begin = share_[member], end = share_[member + 1];
    kicks.drift = step;
    if (scheme_.corrects) return correct(grains_, kicks, begin, end);
    kicks.end_kick = step * scheme_.stages.back().kick;
    kick(grains_, kicks, begin, end);
    kicks.drift = step * scheme_.closing_drift;
    if (kicks.drift > 0) drift(grains_, kicks, begin, end);
}

// Makes lists again that no longer reach far enough.
void StepLoop::renew_contacts(int member, const Evaluation& at, double step, const KickInput& kicks) {
    Member& mine = members_[member];
    const Vec3 drift = drift_since_listing(at.time, step);
    if (!contacts_expired(mine, at.now, drift, std::abs(at.since))) return;
    set_reach(mine, at.now, drift, kicks.frame, step);
    mine.farthest = farthest_of(share_[member], share_[member + 1], drift);
    team_.barrier(member);
    if (lists_expired(mine, at.now, drift)) {
        const bool some_are_new = farthest() > kNowhere / 2;  // then the lists did not expire by themselves
        rebuild(member, at.now, at.time, some_are_new ? kLastsWell : at.time - listed_step_);
        mine.reach.drift.setZero();
    } else {
        refresh(member);
    }
    if (member == 0) ++refreshes_;
}

// The displacement of the whole bed since the lists were made, if it were in free flight. Displacements of
// grains are measured relative to it. The lists stay safe whatever the bed does: two grains come closer by at
// most the sum of their displacements relative to any common frame.
Vec3 StepLoop::drift_since_listing(double time, double step) const {
    const double passed = (time - listed_step_) * step;
    return passed * (listed_velocity_ + 0.5 * passed * around_.gravity);
}

namespace {

// The largest displacement (m) of any face between two poses, relative to a frame displaced by `flown`.
double farthest_face(const std::vector<Face>& faces, const Pose& before, const Pose& now, const Vec3& flown) {
    double squared = 0;
    for (const Face& face : faces) {
        const Vec3 gone = face.displacement(now) - face.displacement(before) - flown;
        squared = std::max(squared, gone.squaredNorm());
    }
    return std::sqrt(squared);
}

}  // namespace

// Whether the contact lists must be refreshed: they no longer reach far enough, or contacts that have parted
// have cost about as much as a refresh. All threads get the same answer, because they add the same numbers.
bool StepLoop::contacts_expired(Member& mine, const Pose& now, const Vec3& drift, double passed) const {
    constexpr std::int64_t kRefresh = 16;  // a refresh takes as long as this many contacts a grain
    Reach& reach = mine.reach;
    Vec3 largest(0, 0, 0);  // by component: the same however the grains are shared out
    for (const Member& m : members_) {
        largest = largest.cwiseMax(m.told[mine.box].fastest);
        reach.parted += m.told[mine.box].parted;
    }
    reach.fastest = largest.norm();
    reach.moved += reach.fastest * passed;
    const Vec3 flown = drift - reach.drift;
    return 2 * reach.moved > reach.skin || reach.parted > kRefresh * std::ssize(grains_.id) ||
           reach.moved + farthest_face(around_.faces, reach.pose, now, flown) > reach.skin;
}

bool StepLoop::lists_expired(const Member& mine, const Pose& now, const Vec3& drift) const {
    const double moved = farthest();
    const double used = moved + std::max(moved, farthest_face(around_.faces, listed_pose_, now, drift));
    return used + mine.reach.skin > skin_;
}

double StepLoop::farthest() const {
    double moved = 0;
    for (const Member& m : members_) moved = std::max(moved, m.farthest);
    return moved;
}

double StepLoop::farthest_of(std::int32_t begin, std::int32_t end, const Vec3& drift) const {
    constexpr double kRounding = 1e-7;  // of floats
    double farthest = 0;
    for (std::int32_t i = begin; i < end; ++i) {
        const Vec3 listed = listed_at_[i].cast<double>();
        const double moved = (grains_.place[i].position - listed - drift).norm();
        farthest = std::max(farthest, moved + kRounding * listed.norm());
    }
    return farthest;
}

// Sets the skin so that the contact lists last for about kStepsPerRefresh steps at the present speeds.
void StepLoop::set_reach(Member& mine, const Pose& now, const Vec3& drift, const Vec3& frame,
                         double step) const {
    constexpr double kStepsPerRefresh = 48, kLeastShare = 1e-3, kMostShare = 0.4;
    Reach& reach = mine.reach;
    double wall = 0;
    for (const Face& face : around_.faces) wall = std::max(wall, (face.velocity_at(now) - frame).norm());
    const double wanted = kStepsPerRefresh * step * (reach.fastest + std::max(reach.fastest, wall));
    reach.skin = std::clamp(wanted, kLeastShare * skin_, kMostShare * skin_);
    reach.moved = 0;
    reach.parted = 0;
    reach.drift = drift;
    reach.pose = now;
}

}  // namespace grainreel
