// The lists of the step loop: making them, refreshing them, and handing over contact histories between
// threads.
#include <algorithm>
#include <numeric>

#include "engine/base/ticks.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

// The work in a step of a contact and of a listed pair. The unit is the work of a grain without contacts.
// Contacts and pairs are counted under their first body.
constexpr double kWorkOfContact = 3, kWorkOfPair = 0.05;

}  // namespace

// Puts the grains in order and makes new neighbour lists. Contacts keep their histories. All members call it.
void StepLoop::rebuild(int member, const Pose& pose, double time, double lasted) {
    Member& mine = members_[member];
    mine.busy_in_all = team_.busy(member);
    const TeamMember me{team_, member};
    if (me.leads()) {
        next_skin_ = skin_after(lasted);  // other members may still read skin_
        if (search_share_.empty() || search_share_.back() != std::ssize(grains_.id)) {
            search_share_.assign(1, 0);
            for (int m = 0; m < team_.size(); ++m)
                search_share_.push_back(TeamMember{team_, m}.part_of(grains_.size()).end);
        }
        if (team_.size() > 1) contacts_.assign(grains_.size(), 0);
    }
    me.wait();
    put_in_order(me, cells_, grains_, next_skin_, around_.period, new_index_);
    if (team_.size() > 1) mine.contacts.count_contacts(new_index_, contacts_);
    const std::int32_t begin = search_share_[member], end = search_share_[member + 1];
    const bool alone = team_.size() == 1;  // then there are no lists to join
    const std::uint64_t since = ticks();
    list_pairs(cells_, grains_, next_skin_, around_.period, begin, end, alone ? lists_.pairs : mine.pairs);
    list_walls(grains_, around_.faces, pose, next_skin_, begin, end, alone ? lists_.walls : mine.walls_near);
    mine.searched_for = static_cast<double>(ticks() - since + 1);
    me.wait();
    if (!alone) join_lists(me);
    me.wait();
    if (member == team_.size() - 1) note_listing(pose, time);
    if (me.leads()) {
        skin_ = next_skin_;
        note_speeds();
        share_out();
        share_search();
        ++rebuilds_;
    }
    me.wait();
    mine.contacts.renumber(rules_, member, {new_index_, last_share_, share_}, mine.leaving);
    me.wait();
    mine.contacts.own(rules_, lists_, share_[member], share_[member + 1]);
    for (const Member& m : members_) mine.contacts.take(member, m.leaving);
    me.wait();
    if (me.leads()) place_halos();
    me.wait();
    refresh(member);
    mine.busy_before = team_.busy(member);
    mine.busy_refreshing = 0;
}

// The next skin (m). Lists that lasted too few steps get a wider skin. Lists that lasted longer than pays get
// a narrower one. With a period the skin stays, because a wider one could list a pair twice.
double StepLoop::skin_after(double lasted) const {
    constexpr double kShort = 400, kLong = 1500;  // steps
    constexpr double kFactor = 1.25;
    if (around_.period > 0) return skin_;
    const double factor = lasted < kShort ? kFactor : lasted > kLong ? 1 / kFactor : 1;
    return std::clamp(factor * skin_, kLeastSkin * around_.skin, kMostSkin * around_.skin);
}

// Joins the lists of all members. Each member copies its own.
void StepLoop::join_lists(const TeamMember& me) {
    NeighbourList& all = lists_.pairs;
    std::size_t pairs = 0, walls = 0, pairs_before = 0, walls_before = 0;
    std::int32_t farthest = 0;
    for (int m = 0; m < team_.size(); ++m) {
        if (m == me.member) pairs_before = pairs, walls_before = walls;
        pairs += members_[m].pairs.size();
        walls += members_[m].walls_near.size();
        farthest = std::max(farthest, members_[m].pairs.farthest_partner);
    }
    if (me.leads()) {
        all.resize(grains_.size(), pairs);
        all.farthest_partner = farthest;
        lists_.walls.resize(walls);
    }
    me.wait();
    const Member& mine = members_[me.member];
    all.put(mine.pairs, search_share_[me.member], pairs_before);
    std::copy(mine.walls_near.begin(), mine.walls_near.end(),
              lists_.walls.begin() + static_cast<std::ptrdiff_t>(walls_before));
}

void StepLoop::note_listing(const Pose& pose, double time) {
    listed_at_.resize(grains_.size());
    listed_velocity_.setZero();
    for (std::size_t i = 0; i < grains_.size(); ++i) {
        listed_at_[i] = grains_.place[i].position.cast<float>();
        listed_velocity_ += grains_.motion[i].velocity;
    }
    listed_velocity_ /= static_cast<double>(grains_.size());
    listed_pose_ = pose;
    listed_step_ = time;
}

// Notes how fast each thread has worked since the last lists, relative to the mean of all. Processors that
// other programs use too may differ by half for seconds. Where nothing is known, the speeds stay as they are.
// The figures are approximate, because contacts have begun and ended since the work was counted.
void StepLoop::note_speeds() {
    constexpr double kMost = 2, kNewShare = 0.5;
    const auto time_of = [](const Member& m) { return m.busy_in_all - m.busy_before - m.busy_refreshing; };
    const auto work_of = [](const Member& m) { return m.work + m.contact_work; };
    double work = 0, time = 0;
    for (const Member& m : members_) work += work_of(m), time += time_of(m);
    if (work <= 0 || time <= 0) return;
    for (Member& m : members_) {
        const double now = (work_of(m) / time_of(m)) / (work / time);
        m.speed += kNewShare * (std::clamp(now, 1 / kMost, kMost) - m.speed);
    }
}

// Gives each thread a range of grains. A faster thread gets more work. The bits do not depend on the ranges.
void StepLoop::share_out() {
    const std::int32_t n = static_cast<std::int32_t>(grains_.size());
    last_share_ = share_;
    share_.assign(team_.size() + 1, n);
    share_[0] = 0;
    if (team_.size() == 1) return;
    const auto work = [&](std::int32_t i) { return i + kWorkOfPair * lists_.pairs.start[i]; };
    const double contacts = std::accumulate(contacts_.begin(), contacts_.end(), 0.0);
    const double all = work(n) + kWorkOfContact * contacts;
    double speed_of_all = 0, speed_before = 0, contact_work = 0;
    for (const Member& m : members_) speed_of_all += m.speed;
    std::int32_t i = 0;
    for (int t = 0; t < team_.size(); ++t) {
        Member& m = members_[t];
        const double work_before = work(i), contact_work_before = contact_work;
        speed_before += m.speed;
        const bool last = t + 1 == team_.size();
        while (i < n && (last || (work(i) + contact_work) * speed_of_all < all * speed_before))
            contact_work += kWorkOfContact * contacts_[i++];
        share_[t + 1] = i;
        m.work = work(i) - work_before;
        m.contact_work = contact_work - contact_work_before;
    }
}

// Refreshes the contact lists. Between two rebuilds, this is the only time that a thread reads grains of
// other threads directly, not as copies.
void StepLoop::refresh(int member) {
    Member& mine = members_[member];
    const double before = team_.busy(member);
    mine.contacts.refresh(rules_, grains_, lists_, around_.faces, mine.reach.pose, mine.reach.skin);
    if (team_.size() == 1) return;
    mine.contacts.list_foreign(rules_, grains_, share_);
    team_.barrier(member);
    mine.busy_refreshing += team_.busy(member) - before;
}

// Sets the ranges of the next search for neighbours, so that all take the same time. It assumes that the next
// search takes as long a grain as the last one did in the same range, and goes half of the way to the new
// ranges. The time a grain differs along the order, because grains look at different numbers of others.
void StepLoop::share_search() {
    double whole = 0, passed = 0;
    for (const Member& m : members_) whole += m.searched_for;
    const Shares& last = last_search_share_ = search_share_;  // no memory is asked for
    int from = 0;                                             // the range that holds the next bound
    for (int t = 1; t < team_.size(); ++t) {
        const double wanted = whole * t / team_.size();
        while (from + 1 < team_.size() && passed + members_[from].searched_for < wanted)
            passed += members_[from++].searched_for;
        const double share = (wanted - passed) / members_[from].searched_for;
        const double at = last[from] + share * (last[from + 1] - last[from]);
        search_share_[t] = static_cast<std::int32_t>((last[t] + at) / 2);
    }
}

// Places the copies of all threads one after the other. No cache line holds copies of two threads.
void StepLoop::place_halos() {
    constexpr std::int32_t kApart = 4;
    const auto n = static_cast<std::int32_t>(grains_.size());
    std::int32_t end = n;
    for (Member& m : members_) {
        const std::int32_t at = (end + kApart - 1) / kApart * kApart;
        m.contacts.halo().make_room(at, team_.size());
        end = at + m.contacts.halo().size();
    }
    if (team_.size() > 1) reserve_copies(grains_, end - n);
}

}  // namespace grainreel
