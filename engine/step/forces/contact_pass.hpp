// The contact pass of one thread. It takes the contacts of the thread's own grains through geometry and law,
// a chunk at a time, and adds the forces to the loads of the grains.
//
// Two threads compute a contact between their grains both, each for its own grain. This is cheaper than
// handing forces over. It also lets every grain sum its contacts in one order, whatever the threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/step/forces/contact_geometry.hpp"
#include "engine/step/forces/integrate.hpp"
#include "engine/step/forces/loads.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/contact_table.hpp"
#include "engine/step/lists/soon.hpp"
#include "engine/step/threads/cost_clock.hpp"
#include "engine/step/threads/halo.hpp"

namespace grainreel {

// The thread that owns the grain.
int owner_of(const Shares& shares, std::int32_t grain);

// A new order of the grains, and new shares of the threads.
struct Renumbering {
    const std::vector<std::int32_t>& index;  // new index of each grain, by its old index
    const Shares &before, &after;
};

class ContactPass {
  public:
    // Adds to `count` the number of contacts of which each own grain is the first body. `index` gives the
    // grain's new number, under which it is counted.
    void count_contacts(const std::vector<std::int32_t>& index, std::vector<std::int32_t>& count) const;

    // Gives the bodies of all contacts their new numbers. Contacts that another thread needs from now on, and
    // did not have, go to `leaving` by group. Their tag is the number of that thread.
    void renumber(const ContactRules& rules, int member, const Renumbering& to,
                  std::vector<KeptContacts>& leaving);
    // Takes the contacts that other threads have put into `leaving` for this one.
    void take(int member, const std::vector<KeptContacts>& leaving);

    // Renumbers contacts after some grains have left; the others keep their order. A grain that has left has
    // the new index kGone, and its contacts are dropped. own() and refresh() must follow.
    static constexpr std::int32_t kGone = -1;
    void leave_out(const ContactRules& rules, const std::vector<std::int32_t>& index);

    // Sets the thread's own grains [begin, end) and finds its pairs in the new neighbour lists.
    void own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t begin, std::int32_t end);

    // The grains of other threads that compute() reads. After own() they are all listed neighbours, which are
    // more than after any refresh().
    Halo& halo() { return halo_; }
    // Call after a refresh: only those of the contacts and candidates are read from now on.
    void list_foreign(const ContactRules& rules, Grains& grains, const Shares& shares);

    // Drops contacts that have parted, and lists new candidates: the pairs of the neighbour lists that are
    // closer than `skin` (m). The neighbour lists are those of own().
    void refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                 const std::vector<Face>& faces, const Pose& pose, double skin);

    // Counts grains that have a load among those that have contacts. A grain that has lost its contact with a
    // grain that left still has the load of that contact for half a step.
    void note_loads(const Grains& grains);
    // The own grains that have contacts.
    const Loaded& loaded() const { return loaded_; }

    // The number of contacts under own grains that no longer touch. They are computed until the next refresh.
    std::int64_t parted() const;

    // For checkpoints: the contacts under own grains by group, and the number of steps since the last
    // refresh.
    void keep(std::vector<KeptContacts>& kept) const;
    std::int32_t steps_since_refresh() const { return tables_[0].step(); }
    // Takes back the kept contacts of own grains.
    void restore(const ContactRules& rules, const std::vector<KeptContacts>& kept, std::int32_t steps);
    // As refresh(), but contacts stay as they are.
    void list_candidates(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                         const std::vector<Face>& faces, const Pose& pose, double skin);

    // One step of all laws. Adds the forces of walls, then those of pairs, to the loads of the own grains,
    // and the work of moving walls to their accounts. Grains of `vanguard` begin their next step as soon as
    // their loads are complete.
    struct Passed {
        double since;  // s, time since the last forces
        double ahead;  // steps, from the time of the known velocity to the time of these forces
        double acts;   // s, how long these forces will act
        double turns;  // s: `since`, or 0 where positions and velocities belong to one time
        double moved;  // m; no grain has moved farther since the last refresh
    };
    void compute(const ContactRules& rules, Grains& grains, const WallState& state, const Passed& passed,
                 Vanguard& vanguard, CostClock& clock);

    // Shows every touching contact of a group under an own grain: its bodies, whether it is late, and its
    // place in the chunks. A late contact began since the last refresh; the others come by rising first and
    // second body. Which contacts are late does not depend on the threads.
    using Seen = std::function<void(std::int32_t first, std::int32_t second, bool late, int at,
                                    const TouchChunk&, const ForceChunk&, const EnergyChunk&)>;
    void observe(const ContactRules& rules, std::size_t group, const Grains& grains, const WallState& state,
                 const Seen& seen) const;

  private:
    // Some contacts, at most kChunk, that stand side by side in arrays.
    struct Chunk {
        const std::int32_t *first, *second;
        int count;
    };
    struct Step {
        const ContactRules& rules;
        std::size_t g;
        const ContactGroup& group;
        Grains& grains;
        const WallState& walls;
        const Passed& passed;
    };

    bool owns(std::int32_t grain) const { return grain >= begin_ && grain < end_; }
    void note_loaded(const ContactRules& rules);
    void note_loaded(bool of_pairs, const ContactTable& table, std::int32_t begin, std::int32_t end);
    void list_near_pairs(const ContactRules& rules, const Grains& grains, const NeighbourList& list,
                         double skin);
    void list_near_walls(const ContactRules& rules, const Grains& grains,
                         const std::vector<WallNeighbour>& list, const std::vector<Face>& faces,
                         const Pose& pose, double skin);
    void renumber_group(const ContactGroup& group, int member, const Renumbering& to, ContactTable& table,
                        KeptContacts& leaving);
    void admit_all(const Step& in, ContactTable& table, std::int32_t from, std::int32_t to);
    void admit_soon(const Step& in, ContactTable& table);
    void admit_soon(const Step& in, ContactTable& table, const SoonList& soon);
    void list_soon(const Step& in, const ContactTable& table, SoonList& soon, double gap);
    static std::uint64_t which_touch(const ContactRules& rules, const ContactGroup& group,
                                     const Grains& grains, const WallState& state, const Chunk& chunk);
    // found: where to read the grains of other threads. With nullptr they are read directly.
    template <class Work>
    static void each_touching_candidate(const ContactRules& rules, const ContactGroup& group,
                                        const ContactTable& table, std::int32_t from, std::int32_t to,
                                        const Grains& grains, const WallState& state, const FoundPairs* found,
                                        const Work& work);
    Halo::Bodies bodies_of(std::size_t g, const ContactGroup& group, std::int32_t c, int count);
    LawInput prepare(const ContactRules& rules, const ContactGroup& group, const Grains& grains,
                     const WallState& state, const Passed& passed, const Chunk& chunk,
                     const Halo::Bodies& bodies, bool rounded) const;
    const std::int32_t* kinds_of(const ContactRules& rules, const ContactGroup& group, const Grains& grains,
                                 const Chunk& chunk) const;
    void compute_stretch(const Step& in, ContactTable& table, std::int32_t begin, std::int32_t end,
                         Vanguard* vanguard, CostClock& clock);
    void compute_chunk(const Step& in, ContactTable& table, std::int32_t c, int count, CostClock& clock);
    void show(const ContactGroup& group, const LawInput& in, const void* history, const Chunk& chunk,
              bool late, const Seen& seen) const;

    std::vector<ContactTable> tables_;  // one a group
    std::int32_t begin_ = 0, end_ = 0;  // the own grains
    struct Pair {
        std::int32_t first, second;
    };
    std::vector<Pair> incoming_;  // listed pairs of a grain of an earlier thread and an own grain
    Halo halo_;
    Loaded loaded_;
    struct Found {
        FoundPairs contacts, candidates;  // the sorted contacts
    };
    std::vector<Found> found_;  // one a group
    std::vector<Soon> soon_;    // one a group, of pairs
    double skin_ = 0;           // m, of the candidates
    mutable TouchChunk touch_;
    mutable ForceChunk force_;
    mutable RollingChunk rolling_;
    mutable std::int32_t kind_[kChunk] = {};  // of the chunk's contacts, where there are several
    Ahead ahead_;
};

}  // namespace grainreel
