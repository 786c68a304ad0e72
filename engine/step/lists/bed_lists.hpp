// All lists of the bed: neighbours, and each thread's contacts and candidates. The threads make them
// together.
//
// The bits of a run do not depend on the number of threads, for three reasons. The grains have one spatial
// order, whatever the team. Every thread computes all contacts of its own grains. Every grain sums its
// contacts in one order: meshes before glued grains before walls before pairs, law by law. Within a law, the
// contacts that began since the last refresh come first, in the order in which they began. Then come the
// contacts in which the grain is the second body, by rising first body, then those in which it is the first
// body, by rising second body.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <vector>

#include "engine/base/team.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/grid/cells.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/candidates.hpp"
#include "engine/step/lists/list_life.hpp"
#include "engine/step/lists/thread_contacts.hpp"
#include "engine/step/motion/scheme.hpp"
#include "engine/step/surroundings.hpp"
#include "engine/step/threads/work_shares.hpp"

namespace grainreel {

class Bytes;

class BedLists {
  public:
    BedLists(const ContactRules& rules, const Surroundings& around, Grains& grains, Team& team);

    // Forgets all contacts. rebuild() must follow, or begin_empty(), which makes the lists of a bed without
    // grains.
    void restart();
    void begin_empty();

    // Puts the grains in order and makes new neighbour lists. Contacts keep their histories. All threads call
    // it. `time` is in steps, and `lasted` is the number of steps that the last lists have lasted.
    void rebuild(int thread, const DrivePose& pose, double time, double lasted);
    // Makes those lists anew that no longer reach far enough. All threads call it in each evaluation.
    // `fastest` and `parted` are as in ListLife::contacts_expired(), and `step` is in s.
    void renew(int thread, const Vec3& fastest, std::int64_t parted, const Evaluation& at, double step,
               const Vec3& frame);

    // The thread's own grains.
    std::int32_t begin(int thread) const { return shares_.begin(thread); }
    std::int32_t end(int thread) const { return shares_.end(thread); }
    ThreadContacts& contacts(int thread) { return threads_[thread].contacts; }
    const ThreadContacts& contacts(int thread) const { return threads_[thread].contacts; }

    ListLife& life() { return life_; }
    const ListLife& life() const { return life_; }

    // Removes grains from the lists between two runs, before they leave the grains' arrays. `leavers` are
    // rising indices. Returns the new index of each grain, kGone for those that leave. renew_shares() must
    // follow.
    const std::vector<std::int32_t>& leave_out(const std::vector<std::int32_t>& leavers);
    // Notes between two runs that a grain has come, after all others. Its lists are made at the end of the
    // next step.
    void add_unlisted();
    // Shares the grains out anew after some have left or come. All grains then have their new indices, and
    // the threads' lists are brought up to date.
    void renew_shares();
    bool are_made() const { return !shares_.empty(); }

    // Gives each touching contact the history that history_of() fills in. Where that returns false, the
    // contact keeps its own. Call it between two runs.
    using HistoryOf =
        std::function<bool(std::size_t group, std::int32_t first, std::int32_t second, double* to)>;
    void take_histories(const HistoryOf& history_of);

    // Writes lists and histories, bit by bit. load() reads them. Reading fails for anything that save()
    // cannot have written with these grains and faces; no index is trusted.
    void save(std::ostream& out) const;
    void load(Bytes& in, const DrivePose& now);

    std::int64_t rebuilds() const { return rebuilds_; }
    std::int64_t refreshes() const { return refreshes_; }
    void clear_counts() { rebuilds_ = refreshes_ = 0; }
    std::size_t listed_pairs() const { return lists_.pairs.size(); }

  private:
    // What a thread writes. It shares no cache line with what another thread writes.
    struct alignas(64) Thread {
        ThreadContacts contacts;
        std::vector<KeptContacts> leaving;  // contacts for other threads, by group
        NeighbourList pairs;                // its part of the search, where there are several threads
        std::vector<WallNeighbour> walls_near, glued_near, meshes_near;
    };

    std::int32_t grains() const { return static_cast<std::int32_t>(grains_.size()); }
    // The input of a search, for grains and walls as they are now.
    Nearby nearby(const DrivePose& now, double skin) const;
    void search(int thread, const DrivePose& pose);
    void join_parts(const TeamMember& me);
    std::ptrdiff_t found_before(int thread, std::vector<WallNeighbour> Thread::*part) const;
    void change_owners(const TeamMember& me);
    void place_halos();
    void refresh(int thread);

    std::vector<KeptContacts> all_kept() const;
    template <class Lists, class Kept, class ReachType, class Each>
    static void transfer(Lists& lists, Kept& kept, std::int32_t& steps, ReachType& reach, const Each& each);
    bool is_sound(const std::vector<KeptContacts>& kept, std::int32_t steps, const Reach& reach) const;

    const ContactRules& rules_;
    const Surroundings& around_;
    Grains& grains_;
    Team& team_;
    Cells cells_;
    GluedSearch glued_;
    NeighbourLists lists_;
    ListLife life_;
    WorkShares shares_;
    std::vector<Thread> threads_;
    std::vector<std::int32_t> new_index_;  // new index of each grain in the last reordering
    std::vector<std::int32_t>
        contacts_;  // number of contacts of each grain as first body, when the lists were made
    std::int64_t rebuilds_ = 0, refreshes_ = 0;
};

}  // namespace grainreel
