// The contact pass of one thread: the contacts of its own grains, a chunk at a time, through geometry and law
// into the loads of its grains. A contact between grains of two threads is computed by both, each for its own
// grain: cheaper than handing forces over, and every grain sums its contacts in one order, whatever the
// threads.
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

int owner_of(const Shares& shares, std::int32_t grain);

// Grains in a new order, and shared out anew.
struct Renumbering {
    const std::vector<std::int32_t>& index;  // the new one of each old one
    const Shares &before, &after;
};

class ContactPass {
  public:
    // Adds to each own grain's count, which stands under the grain's new number, the contacts of which it is
    // the first body.
    void count_contacts(const std::vector<std::int32_t>& index, std::vector<std::int32_t>& count) const;

    // New numbers for all contacts; those that another thread has to do with from now on, and had not, go to
    // `leaving` by group, tagged with it.
    void renumber(const ContactRules& rules, int member, const Renumbering& to,
                  std::vector<KeptContacts>& leaving);
    // The other end of that.
    void take(int member, const std::vector<KeptContacts>& leaving);

    // New numbers where some grains, whose new index is kGone, have left and the others keep their order. The
    // contacts of those are dropped. own() and refresh() are to follow.
    static constexpr std::int32_t kGone = -1;
    void leave_out(const ContactRules& rules, const std::vector<std::int32_t>& index);

    // Sets the thread's own grains [begin, end) and finds its pairs in the new neighbour lists.
    void own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t begin, std::int32_t end);

    // The other threads' grains that compute() reads: after own(), all that are listed, which are more than
    // after any refresh().
    Halo& halo() { return halo_; }
    // After a refresh: those of the contacts and candidates.
    void list_foreign(const ContactRules& rules, Grains& grains, const Shares& shares);

    // Drops contacts that have parted, and takes from the neighbour lists, those of own(), what may come to
    // touch within `skin` (m).
    void refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                 const std::vector<Face>& faces, const Pose& pose, double skin);

    // A force that is still to act, half a step long, of a contact with a grain that has left: the grain
    // counts as one that has contacts.
    void note_loads(const Grains& grains);
    // Of the own grains, those that have contacts.
    const Loaded& loaded() const { return loaded_; }

    // Contacts under own grains that no longer touch, and are computed all the same until the next refresh.
    std::int64_t parted() const;

    // For checkpoints: the contacts under own grains by group, and how many steps ago their order began.
    void keep(std::vector<KeptContacts>& kept) const;
    std::int32_t steps_since_refresh() const { return tables_[0].step(); }
    // Takes back what has to do with own grains.
    void restore(const ContactRules& rules, const std::vector<KeptContacts>& kept, std::int32_t steps);
    // As refresh(), but contacts stay as they are.
    void list_candidates(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                         const std::vector<Face>& faces, const Pose& pose, double skin);

    // One step of all laws: adds the forces, of walls before those of pairs, to the loads of the own grains,
    // and the moving walls' work to them. Grains go on as soon as their loads are complete.
    struct Passed {
        double since;  // s, since the last forces
        double ahead;  // steps, from the velocity between the two to that of now
        double acts;   // s, that the forces will act
        double turns;  // s: `since`, or 0 where positions and velocities are of one time
        double moved;  // m, that no grain has surpassed since the last refresh
    };
    void compute(const ContactRules& rules, Grains& grains, const WallState& state, const Passed& passed,
                 Vanguard& vanguard, CostClock& clock);

    // Shows every contact of a group under an own grain that touches: its bodies, where to find it in the
    // chunks, and whether it is late: the others come by rising first and second body, and which are late
    // does not depend on the threads.
    using Seen = std::function<void(std::int32_t first, std::int32_t second, bool late, int at,
                                    const TouchChunk&, const ForceChunk&, const EnergyChunk&)>;
    void observe(const ContactRules& rules, std::size_t group, const Grains& grains, const WallState& state,
                 const Seen& seen) const;

  private:
    // Contacts that stand side by side in a table, or were packed.
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
    // found: where other threads' grains are read; nullptr to read them where they are.
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
    std::vector<Pair> incoming_;  // listed pairs of an earlier thread's grain and an own one
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
