// The contacts of one thread's own grains, and what the thread needs to compute them.
//
// Two threads compute a contact between their grains both, each for its own grain. This is cheaper than
// handing forces over. It also lets every grain sum its contacts in one order, whatever the threads.
//
// Who changes the contacts: candidates.hpp at each refresh, new_contacts.hpp in each step, and
// change_owners.hpp when grains get other owners or leave.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/contact_table.hpp"
#include "engine/step/lists/mesh_near.hpp"
#include "engine/step/lists/soon.hpp"
#include "engine/step/motion/loaded.hpp"
#include "engine/step/threads/halo.hpp"

namespace grainreel {

struct ThreadContacts {
    struct Pair {
        std::int32_t first, second;
    };
    // Where to read the bodies of the sorted contacts and of the candidates.
    struct Found {
        FoundPairs contacts, candidates;
    };

    std::int32_t begin = 0, end = 0;   // the own grains
    std::vector<ContactTable> tables;  // one a group
    std::vector<Found> found;          // one a group
    std::vector<Soon> soon;            // one a group, of pairs
    std::vector<MeshLists> meshes;     // one a group, of meshes
    std::optional<MeshFault> fault;    // the first one; it ends the run
    double skin = 0;                   // m, of the candidates
    std::vector<Pair> incoming;        // listed pairs of a grain of an earlier thread and an own grain
    Halo halo;                         // copies of other threads' grains
    Loaded loaded;                     // own grains that have contacts

    bool owns(std::int32_t grain) const { return grain >= begin && grain < end; }

    // Sets the thread's own grains and finds its pairs in the new neighbour lists. The halo then needs all
    // listed neighbours, which are more than it needs after any refresh.
    void own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t first_own,
             std::int32_t end_own);
    // Call after a refresh: only those of the contacts and candidates are read from now on.
    void list_foreign(const ContactRules& rules, Grains& grains, const Shares& shares);
    // Where to read the bodies of `count` contacts of a group from c on. Valid until the next call.
    Halo::Bodies bodies_of(const ContactRules& rules, std::size_t group, std::int32_t c, int count);

    // Notes the own grains of all contacts, or of the contacts [from, to) of a group.
    void note_loaded(const ContactRules& rules);
    void note_loaded(const ContactRules& rules, std::size_t group, std::int32_t from, std::int32_t to);

    // The number of contacts under own grains that no longer touch. They are computed until the next refresh.
    std::int64_t parted() const;

    // For checkpoints: the contacts under own grains by group, and the number of steps since the last
    // refresh.
    void keep(std::vector<KeptContacts>& kept) const;
    std::int32_t steps_since_refresh() const { return tables[0].step(); }
    // Takes back the kept contacts of own grains.
    void restore(const ContactRules& rules, const std::vector<KeptContacts>& kept, std::int32_t steps);
};

}  // namespace grainreel
