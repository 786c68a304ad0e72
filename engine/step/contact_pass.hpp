// The contact pass of one thread: all contacts of its own grains, chunk by chunk through geometry and law,
// into the loads of its grains. A contact between grains of two threads is computed by both, each for its own
// grain: cheaper than handing forces over, and every grain sums its contacts in one order, whatever the
// threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/step/contact_geometry.hpp"
#include "engine/step/contact_list.hpp"
#include "engine/step/contact_rules.hpp"
#include "engine/step/cost_clock.hpp"
#include "engine/step/loads.hpp"
#include "engine/step/neighbours.hpp"

namespace grainreel {

class ContactPass {
  public:
    // Sets the thread's own grains [begin, end) and finds its pairs in the new neighbour lists.
    void own(const NeighbourLists& lists, std::int32_t begin, std::int32_t end);

    // Takes from the neighbour lists what may touch within `skin` (m). Histories are carried when the
    // neighbour lists are those of the last refresh.
    void refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                 const std::vector<Face>& faces, const Pose& pose, double skin, bool carry_histories);

    // The contacts under own grains that have a history, by group.
    void keep(std::vector<KeptContacts>& kept) const;
    // Takes back those of one group that have to do with an own grain, numbered as the grains are now.
    void restore(const ContactRules& rules, std::size_t group, const KeptContacts& kept,
                 const std::vector<std::int32_t>& index);

    // One step of all laws: adds the forces of pairs, then of walls, to the loads of the own grains, and the
    // moving walls' work to them.
    struct Times {
        double since;  // s, since the last forces
        double ahead;  // steps, from the velocity between the two to that of now
        double acts;   // s, that the forces will act
        double turns;  // s: `since`, or 0 where positions and velocities are of one time
    };
    void compute(const ContactRules& rules, Grains& grains, const WallState& state, const Times& times,
                 CostClock& clock);

    // Shows every contact of a group under an own grain that touches: its bodies, and where to find it in the
    // chunks.
    using Seen = std::function<void(std::int32_t first, std::int32_t second, int at, const TouchChunk&,
                                    const ForceChunk&, const EnergyChunk&)>;
    void observe(const ContactRules& rules, std::size_t group, const Grains& grains, const WallState& state,
                 const Seen& seen) const;

  private:
    template <class Law>
    void each_chunk(const ContactRules& rules, std::size_t group, const Grains& grains,
                    const WallState& state, const Times& times, const Law& law) const;
    void add_pairs_within(const ContactRules& rules, const Grains& grains, const NeighbourList& list,
                          double skin);

    std::vector<ContactList> lists_;    // one a group
    std::int32_t begin_ = 0, end_ = 0;  // the own grains
    struct Pair {
        std::int32_t slot, first;
    };
    std::vector<Pair> incoming_;  // listed pairs of an earlier thread's grain and an own one
    mutable TouchChunk touch_;
    mutable ForceChunk force_;
    mutable RollingChunk rolling_;
    LoadChunk loads_;
};

}  // namespace grainreel
