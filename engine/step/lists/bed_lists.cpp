#include "engine/step/lists/bed_lists.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/base/binary.hpp"
#include "engine/base/system/processor.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/candidates.hpp"
#include "engine/step/lists/change_owners.hpp"
#include "engine/step/lists/saved_lists.hpp"

namespace grainreel {

BedLists::BedLists(const ContactRules& rules, const Surroundings& around, Grains& grains, Team& team)
    : rules_(rules),
      around_(around),
      grains_(grains),
      team_(team),
      glued_(around.glued, around.faces, around.period),
      life_(around, team.size()),
      shares_(team),
      threads_(team.size()) {}

void BedLists::restart() {
    life_.restart();
    for (Thread& thread : threads_) thread.contacts = {};
    clear_counts();
}

void BedLists::begin_empty() {
    restart();
    lists_ = {};
    lists_.pairs.resize(0, 0);
    shares_.clear();
    for (Thread& thread : threads_) thread.contacts.own(rules_, lists_, 0, 0);
}

void BedLists::renew(int thread, const Vec3& fastest, std::int64_t parted, const Evaluation& at, double step,
                     const Vec3& frame) {
    const Vec3 drift = life_.drift(at.time, step);
    if (!life_.contacts_expired(thread, fastest, parted, grains(), at, drift)) return;
    life_.set_reach(thread, at.now, drift, frame, step);
    life_.measure(thread, grains_, begin(thread), end(thread), drift);
    team_.barrier(thread);
    if (life_.lists_expired(thread, at.now, drift)) {
        rebuild(thread, at.now, at.time, life_.lasted(at.time));
        life_.reach(thread).drift.setZero();
    } else {
        refresh(thread);
    }
    if (thread == 0) ++refreshes_;
}

void BedLists::rebuild(int thread, const DrivePose& pose, double time, double lasted) {
    const TeamMember me{team_, thread};
    shares_.begin_lists(thread);
    if (me.leads()) {
        life_.set_next_skin(lasted);
        shares_.begin_search(grains());
        if (team_.size() > 1) contacts_.assign(grains_.size(), 0);
    }
    me.wait();
    put_in_order(me, cells_, grains_, life_.next_skin(), around_.period, new_index_);
    if (team_.size() > 1) count_contacts(threads_[thread].contacts, new_index_, contacts_);
    search(thread, pose);
    me.wait();
    if (team_.size() > 1) join_parts(me);
    me.wait();
    if (thread == team_.size() - 1) life_.note_listing(grains_, pose, time);
    if (me.leads()) {
        life_.use_next_skin();
        shares_.renew(lists_.pairs, contacts_, grains());
        ++rebuilds_;
    }
    me.wait();
    change_owners(me);
    if (me.leads()) place_halos();
    me.wait();
    refresh(thread);
    shares_.end_lists(thread);
}

// Searches for the neighbours of the thread's part of the grains. A single thread writes the joint lists
// directly.
void BedLists::search(int thread, const DrivePose& pose) {
    const bool alone = team_.size() == 1;
    Thread& mine = threads_[thread];
    const std::int32_t begin = shares_.search_begin(thread), end = shares_.search_end(thread);
    const std::uint64_t since = ticks();
    list_pairs(cells_, grains_, life_.next_skin(), around_.period, begin, end,
               alone ? lists_.pairs : mine.pairs);
    list_walls(grains_, around_.faces, pose, life_.next_skin(), begin, end,
               alone ? lists_.walls : mine.walls_near);
    glued_.list(grains_, pose, life_.next_skin(), begin, end, alone ? lists_.glued : mine.glued_near);
    list_meshes(grains_, around_.meshes, pose, life_.next_skin(), begin, end,
                alone ? lists_.meshes : mine.meshes_near);
    shares_.searched(thread, static_cast<double>(ticks() - since + 1));
}

// Joins what the threads have found. Each thread copies its own part.
void BedLists::join_parts(const TeamMember& me) {
    NeighbourList& all = lists_.pairs;
    std::size_t pairs = 0, pairs_before = 0;
    std::int32_t farthest = 0;
    for (int t = 0; t < team_.size(); ++t) {
        if (t == me.member) pairs_before = pairs;
        pairs += threads_[t].pairs.size();
        farthest = std::max(farthest, threads_[t].pairs.farthest_partner);
    }
    if (me.leads()) {
        all.resize(grains_.size(), pairs);
        all.farthest_partner = farthest;
        lists_.walls.resize(found_before(team_.size(), &Thread::walls_near));
        lists_.glued.resize(found_before(team_.size(), &Thread::glued_near));
        lists_.meshes.resize(found_before(team_.size(), &Thread::meshes_near));
    }
    me.wait();
    const Thread& mine = threads_[me.member];
    all.put(mine.pairs, shares_.search_begin(me.member), pairs_before);
    for (const auto& [part, whole] : {std::pair{&Thread::walls_near, &lists_.walls},
                                      {&Thread::glued_near, &lists_.glued},
                                      {&Thread::meshes_near, &lists_.meshes}})
        std::copy((mine.*part).begin(), (mine.*part).end(), whole->begin() + found_before(me.member, part));
}

// How many wall neighbours of one sort the threads before this one have found.
std::ptrdiff_t BedLists::found_before(int thread, std::vector<WallNeighbour> Thread::*part) const {
    std::ptrdiff_t count = 0;
    for (int t = 0; t < thread; ++t) count += std::ssize(threads_[t].*part);
    return count;
}

// Hands the contacts over to the threads that own their grains from now on.
void BedLists::change_owners(const TeamMember& me) {
    Thread& mine = threads_[me.member];
    renumber(rules_, me.member, {new_index_, shares_.before(), shares_.now()}, mine.contacts, mine.leaving);
    me.wait();
    mine.contacts.own(rules_, lists_, begin(me.member), end(me.member));
    for (const Thread& thread : threads_) take(me.member, thread.leaving, mine.contacts);
    me.wait();
}

// Places the copies of all threads one after the other. No cache line holds copies of two threads.
void BedLists::place_halos() {
    constexpr std::int32_t kApart = 4;
    std::int32_t end_of_copies = grains();
    for (Thread& thread : threads_) {
        const std::int32_t at = (end_of_copies + kApart - 1) / kApart * kApart;
        thread.contacts.halo.make_room(at, team_.size());
        end_of_copies = at + thread.contacts.halo.size();
    }
    if (team_.size() > 1) reserve_copies(grains_, end_of_copies - grains());
}

Nearby BedLists::nearby(const DrivePose& now, double skin) const {
    return {grains_, lists_, around_.faces, around_.glued, around_.meshes, now, skin};
}

// Refreshes the contact lists. Between two rebuilds, this is the only time that a thread reads grains of
// other threads directly, not as copies.
void BedLists::refresh(int thread) {
    ThreadContacts& mine = contacts(thread);
    const double before = team_.busy(thread);
    const Reach& reach = life_.reach(thread);
    grainreel::refresh(rules_, nearby(reach.pose, reach.skin), mine);
    if (team_.size() == 1) return;
    mine.list_foreign(rules_, grains_, shares_.now());
    team_.barrier(thread);
    shares_.refreshed(thread, team_.busy(thread) - before);
}

const std::vector<std::int32_t>& BedLists::leave_out(const std::vector<std::int32_t>& leavers) {
    new_index_.assign(grains_.size(), 0);
    for (const std::int32_t i : leavers) new_index_[i] = kGone;
    std::int32_t next = 0;
    for (std::int32_t& i : new_index_)
        if (i != kGone) i = next++;
    shares_.leave_out(leavers);
    grainreel::leave_out(new_index_, lists_);
    life_.leave_out(new_index_);
    for (Thread& thread : threads_) grainreel::leave_out(rules_, new_index_, thread.contacts);
    return new_index_;
}

void BedLists::add_unlisted() {
    life_.add_unlisted();
    lists_.pairs.start.push_back(lists_.pairs.start.back());
    shares_.append(grains());
}

void BedLists::renew_shares() {
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    team_.run([&](int thread) {
        contacts(thread).own(rules_, lists_, begin(thread), end(thread));
        team_.barrier(thread);
        if (thread == 0) place_halos();
        team_.barrier(thread);
        refresh(thread);
    });
}

// Saving and loading of lists and histories.

namespace {

// Puts contacts into the order in which they are computed.
KeptContacts in_order(const KeptContacts& kept, int numbers) {
    std::vector<std::int32_t> order(kept.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return order_of(kept, a) < order_of(kept, b); });
    KeptContacts sorted;
    for (const std::int32_t c : order) {
        sorted.first.push_back(kept.first[c]);
        sorted.second.push_back(kept.second[c]);
        sorted.tag.push_back(kept.tag[c]);
        const auto history = kept.history.begin() + static_cast<std::ptrdiff_t>(c) * numbers;
        sorted.history.insert(sorted.history.end(), history, history + numbers);
    }
    return sorted;
}

}  // namespace

// All contacts in one order, which does not depend on the threads.
std::vector<KeptContacts> BedLists::all_kept() const {
    std::vector<KeptContacts> all(rules_.groups.size()), part;
    for (const Thread& thread : threads_) {
        thread.contacts.keep(part);
        for (std::size_t g = 0; g < part.size(); ++g) all[g].append(part[g]);
    }
    for (std::size_t g = 0; g < all.size(); ++g) all[g] = in_order(all[g], rules_.groups[g].history_size());
    return all;
}

// Calls each() for everything that is saved, in the order of the file.
template <class Lists, class Kept, class ReachType, class Each>
void BedLists::transfer(Lists& lists, Kept& kept, std::int32_t& steps, ReachType& reach, const Each& each) {
    for (auto& group : kept) each(group.first), each(group.second), each(group.tag), each(group.history);
    each(steps);
    each(lists.lists_.pairs.start), each(lists.lists_.pairs.partner);
    each(lists.lists_.pairs.farthest_partner);
    each(lists.lists_.walls);
    if (!lists.around_.glued.empty()) each(lists.lists_.glued);
    if (!lists.around_.meshes.empty()) each(lists.lists_.meshes);
    ListLife::transfer(lists.life_, each);
    each(reach);
}

void BedLists::save(std::ostream& out) const {
    const std::vector<KeptContacts> kept = all_kept();
    std::int32_t steps = contacts(0).steps_since_refresh();
    transfer(*this, kept, steps, life_.reach(0), Writing{out});
}

void BedLists::load(Bytes& in, const DrivePose& now) {
    std::vector<KeptContacts> kept(rules_.groups.size());
    Reach reach;
    std::int32_t steps = 0;
    transfer(*this, kept, steps, reach, Reading{in});
    if (in.failed() || !is_sound(kept, steps, reach)) return in.fail();  // the caller reports it
    if (team_.size() > 1) contacts_.assign(grains_.size(), 0);
    shares_.share_out(lists_.pairs, contacts_, grains());
    for (int thread = 0; thread < team_.size(); ++thread) {
        life_.reach(thread) = reach;
        ThreadContacts& mine = contacts(thread);
        mine = {};
        mine.own(rules_, lists_, begin(thread), end(thread));
        mine.restore(rules_, kept, steps);
    }
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    place_halos();
    for (Thread& thread : threads_) {
        list_candidates(rules_, nearby(now, reach.skin), thread.contacts);
        if (team_.size() > 1) thread.contacts.list_foreign(rules_, grains_, shares_.now());
    }
}

// A contact between grains of two threads is in the tables of both. All patches of a mesh that a grain
// touches take the same history.
void BedLists::take_histories(const HistoryOf& history_of) {
    for (Thread& thread : threads_) {
        for (std::size_t g = 0; g < thread.contacts.tables.size(); ++g) {
            const ContactGroup& group = rules_.groups[g];
            thread.contacts.tables[g].take_histories(
                group.law_size(), [&](std::int32_t first, std::int32_t second, double* to) {
                    return history_of(g, first, group.of_mesh ? mesh_of(second) : second, to);
                });
        }
    }
}

// Whether the loop could have made what load() read, with these grains and faces.
bool BedLists::is_sound(const std::vector<KeptContacts>& kept, std::int32_t steps, const Reach& reach) const {
    const WallParts walls = parts_of(around_);
    bool sound = steps >= 0 && steps <= kMostStepsOfLists && are_sound(lists_, grains(), walls) &&
                 life_.is_sound(grains(), reach);
    for (std::size_t g = 0; sound && g < kept.size(); ++g)
        sound = are_sound(kept[g], rules_, g, grains_, walls, steps);
    return sound;
}

}  // namespace grainreel
