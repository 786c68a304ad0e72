#include "engine/step/threads/work_shares.hpp"

#include <algorithm>
#include <numeric>

namespace grainreel {

namespace {

// The work that a contact and a listed pair take in a step, in units of the work of a grain without contacts.
// Contacts and pairs are counted under their first body.
constexpr double kWorkOfContact = 3, kWorkOfPair = 0.05;

}  // namespace

void WorkShares::begin_search(std::int32_t grains) {
    if (!search_share_.empty() && search_share_.back() == grains) return;
    search_share_.assign(1, 0);
    for (int t = 0; t < team_.size(); ++t)
        search_share_.push_back(static_cast<std::int32_t>(std::int64_t{grains} * (t + 1) / team_.size()));
}

void WorkShares::renew(const NeighbourList& pairs, const std::vector<std::int32_t>& contacts,
                       std::int32_t grains) {
    note_speeds();
    share_out(pairs, contacts, grains);
    share_search();
}

// Notes how fast each thread has worked since the last lists, relative to the mean of all. Processors that
// other programs use too may differ by half for seconds. Where nothing is known, the speeds stay as they are.
// The figures are approximate, because contacts have begun and ended since the work was counted.
void WorkShares::note_speeds() {
    constexpr double kMost = 2, kNewShare = 0.5;
    const auto time_of = [](const Thread& t) { return t.busy_in_all - t.busy_before - t.busy_refreshing; };
    const auto work_of = [](const Thread& t) { return t.work + t.contact_work; };
    double work = 0, time = 0;
    for (const Thread& t : threads_) work += work_of(t), time += time_of(t);
    if (work <= 0 || time <= 0) return;
    for (Thread& t : threads_) {
        const double now = (work_of(t) / time_of(t)) / (work / time);
        t.speed += kNewShare * (std::clamp(now, 1 / kMost, kMost) - t.speed);
    }
}

void WorkShares::share_out(const NeighbourList& pairs, const std::vector<std::int32_t>& contacts,
                           std::int32_t n) {
    last_share_ = share_;
    share_.assign(team_.size() + 1, n);
    share_[0] = 0;
    if (team_.size() == 1) return;
    const auto work = [&](std::int32_t i) { return i + kWorkOfPair * pairs.start[i]; };
    const double all = work(n) + kWorkOfContact * std::accumulate(contacts.begin(), contacts.end(), 0.0);
    double speed_of_all = 0, speed_before = 0, contact_work = 0;
    for (const Thread& t : threads_) speed_of_all += t.speed;
    std::int32_t i = 0;
    for (int t = 0; t < team_.size(); ++t) {
        Thread& thread = threads_[t];
        const double work_before = work(i), contact_work_before = contact_work;
        speed_before += thread.speed;
        const bool last = t + 1 == team_.size();
        while (i < n && (last || (work(i) + contact_work) * speed_of_all < all * speed_before))
            contact_work += kWorkOfContact * contacts[i++];
        share_[t + 1] = i;
        thread.work = work(i) - work_before;
        thread.contact_work = contact_work - contact_work_before;
    }
}

// Sets the ranges of the next search for neighbours, so that all threads take the same time. It assumes that
// the next search takes as long per grain as the last one did in the same range, and goes half of the way to
// the new ranges. The search time per grain varies along the order of the grains, because grains look at
// different numbers of others.
void WorkShares::share_search() {
    double whole = 0, passed = 0;
    for (const Thread& t : threads_) whole += t.searched_for;
    const Shares& last = last_search_share_ = search_share_;  // the assignment reuses its memory
    int from = 0;                                             // the range that holds the next bound
    for (int t = 1; t < team_.size(); ++t) {
        const double wanted = whole * t / team_.size();
        while (from + 1 < team_.size() && passed + threads_[from].searched_for < wanted)
            passed += threads_[from++].searched_for;
        const double share = (wanted - passed) / threads_[from].searched_for;
        const double at = last[from] + share * (last[from + 1] - last[from]);
        search_share_[t] = static_cast<std::int32_t>((last[t] + at) / 2);
    }
}

void WorkShares::leave_out(const std::vector<std::int32_t>& leavers) {
    for (std::int32_t& share : share_)
        share -= static_cast<std::int32_t>(std::lower_bound(leavers.begin(), leavers.end(), share) -
                                           leavers.begin());
}

}  // namespace grainreel
