// The contact pass of one thread: of all near pairs of its own grains those that touch, packed into chunks,
// through geometry and law into the loads of its grains. A contact between grains of two threads is computed
// by both, each for its own grain: cheaper than handing forces over, and every grain sums its contacts in one
// order, whatever the threads.
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
    void own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t begin, std::int32_t end);

    // Takes from the neighbour lists, those of own(), what may touch within `skin` (m).
    void refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                 const std::vector<Face>& faces, const Pose& pose, double skin);

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
    // Contacts that touch, on their way through geometry and law.
    struct Chunk {
        int count = 0;
        alignas(64) std::int32_t first[kChunk], second[kChunk], kind[kChunk], row[kChunk];

        void fill_up();
        int filled() const { return (count + kBlock - 1) / kBlock * kBlock; }
    };

    void list_pairs_within(const ContactRules& rules, const Grains& grains, const NeighbourList& list,
                           double skin);
    void list_walls_within(const ContactRules& rules, const Grains& grains,
                           const std::vector<WallNeighbour>& list, const std::vector<Face>& faces,
                           const Pose& pose, double skin);
    std::uint64_t which_touch(const ContactRules& rules, std::size_t group, const Grains& grains,
                              const WallState& state, std::int32_t c) const;
    template <class TouchingFrom, class Row, class Work>
    void pack(const ContactList& list, const TouchingFrom& touching_from, const Row& row,
              const Work& work) const;
    LawInput prepare(const ContactRules& rules, std::size_t group, const Grains& grains,
                     const WallState& state, const Times& times) const;
    void compute_chunk(const ContactRules& rules, std::size_t group, Grains& grains, const WallState& state,
                       const Times& times, CostClock& clock);

    std::vector<ContactList> lists_;    // one a group
    std::int32_t begin_ = 0, end_ = 0;  // the own grains
    struct Pair {
        std::int32_t first, second;
    };
    std::vector<Pair> incoming_;  // listed pairs of an earlier thread's grain and an own one
    mutable Chunk chunk_;
    mutable Histories history_;  // of the chunk
    mutable TouchChunk touch_;
    mutable ForceChunk force_;
    mutable RollingChunk rolling_;
    LoadChunk loads_;
};

}  // namespace grainreel
