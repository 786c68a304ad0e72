// The contacts of one thread's own grains, and what the thread needs to compute them.
//
// A contact between grains of two threads is computed by both, each for its own grain. This is cheaper than
// handing forces over. It also lets every grain sum its contacts in one order, whatever the threads.
//
// Three parts change the contacts: candidates.hpp at each refresh, add_new_contacts() in each step, and
// change_owners.hpp when grains get other owners or leave.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/system/processor.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/contact_table.hpp"
#include "engine/step/lists/mesh_near.hpp"
#include "engine/step/lists/screen_watch.hpp"
#include "engine/step/motion/integrate.hpp"
#include "engine/step/threads/halo.hpp"

namespace grainreel {

// SoonList and Soon list the candidate pairs that may touch within a few steps. A step looks at these pairs
// only. Candidates must serve for some fifty steps, so few of them are near at any time. A list is made anew
// once the grains may have moved as far as its gap allows.
//
// The candidates are cut into several stretches, and each stretch has its own list. The lists are made in
// different steps. If all were made in the same step, one thread would wait for the other in that step.
//
// What this gains: without it a bed in flight takes 12 % more instructions, the vibrated wedge 19 %, and
// dense beds 1 % (docs/notes/performance.md, "Three devices of the step").

// The list for the candidates [from, to). It has room for half of them. If more are near, a list would save
// little, and the step looks at all of them.
class SoonList {
  public:
    SoonList() = default;
    // Memory for the list: `size` pairs, a whole number of blocks.
    struct Room {
        std::int32_t *first, *second, *at;
        std::int32_t size;
    };
    SoonList(std::int32_t from, std::int32_t to, const Room& room) : from_(from), to_(to), room_(room) {}
    std::int32_t from() const { return from_; }
    std::int32_t to() const { return to_; }

    // Whether the list is still complete; false before begin(). No grain has moved farther than `moved` (m)
    // since the candidates were listed.
    bool lasts(double moved) const { return moved <= lasts_until_; }
    // Begins a new list of the pairs that are closer than `gap` (m). Call add() for each pair by rising place
    // while there is room, then end().
    void begin(double moved, double gap) {
        constexpr double kKeptBack = 0.1;  // reserve for rounding and for what a corrector adds
        lasts_until_ = moved + (1 - kKeptBack) * gap / 2;
        count_ = 0;
        all_ = false;
    }
    bool has_room(int more) const { return count_ + more <= room_.size; }
    void add(std::int32_t first, std::int32_t second, std::int32_t at) {
        room_.first[count_] = first, room_.second[count_] = second, room_.at[count_++] = at;
    }
    // Fills the last block with copies of the last pair, so that whole registers can be read.
    void end() {
        for (std::int32_t k = count_; k % kBlock != 0; ++k)
            room_.first[k] = room_.first[k - 1], room_.second[k] = room_.second[k - 1];
    }
    // Gives up the list. The step looks at all candidates for as long as the list would have lasted.
    void give_up() { all_ = true; }
    bool are_all() const { return all_; }

    std::int32_t size() const { return count_; }
    // The indices at which to read the two bodies, and the place of the pair among the candidates.
    const std::int32_t* first() const { return room_.first; }
    const std::int32_t* second() const { return room_.second; }
    std::int32_t at(std::int32_t k) const { return room_.at[k]; }

  private:
    std::int32_t from_ = 0, to_ = 0, count_ = 0;
    Room room_{nullptr, nullptr, nullptr, 0};
    bool all_ = false;
    double lasts_until_ = -std::numeric_limits<double>::infinity();  // m
};

// The lists of all stretches.
class Soon {
  public:
    // A list lasts about five steps. With five lists, about one of them is made in each step.
    static constexpr int kLists = 5;

    Soon() = default;
    Soon(Soon&&) = default;  // not copied: the lists point into the room
    Soon& operator=(Soon&&) = default;

    // Call when there are new candidates. begin() of each list must follow before the list is used.
    void expire(std::int32_t candidates) {
        const auto bound = [&](int k) {
            return k < kLists ? candidates / kChunk * k / kLists * kChunk : candidates;
        };
        const std::size_t room = (candidates / 2 + kBlock - 1) / kBlock * kBlock;
        for (auto* array : {&first_, &second_, &at_}) {
            if (array->capacity() < room) array->reserve(room + room / 8);
            array->resize(room);
        }
        for (int k = 0; k < kLists; ++k) {
            const std::int32_t from = bound(k) / 2, size = (bound(k + 1) - bound(k)) / 2;
            const std::int32_t blocks = (size + kBlock - 1) / kBlock * kBlock;
            list_[k] = {bound(k),
                        bound(k + 1),
                        {first_.data() + from, second_.data() + from, at_.data() + from, blocks}};
        }
        is_new_ = true;
    }
    // Calls work(list, gap) for each list. After expire(), the gaps are one fifth, two fifths and so on, so
    // that the lists run out one after the other.
    template <class Work>
    void each(double gap, const Work& work) {
        for (int k = 0; k < kLists; ++k) work(list_[k], is_new_ ? gap * (k + 1) / kLists : gap);
        is_new_ = false;
    }

  private:
    LargeArray<std::int32_t> first_, second_, at_;
    std::array<SoonList, kLists> list_;
    bool is_new_ = true;
};

struct ThreadContacts {
    struct Pair {
        std::int32_t first, second;
    };
    // The indices at which to read the bodies of the sorted contacts and of the candidates.
    struct Found {
        FoundPairs contacts, candidates;
    };

    std::int32_t begin = 0, end = 0;   // the own grains
    std::vector<ContactTable> tables;  // one for each group
    std::vector<Found> found;          // one for each group
    std::vector<Soon> soon;            // one for each group of pairs
    std::vector<MeshLists> meshes;     // one for each group of meshes
    ScreenWatch screens;               // what may be screened from each other
    std::optional<MeshFault> fault;    // the first one; it ends the run
    double skin = 0;                   // m, of the candidates
    std::vector<Pair> incoming;        // listed pairs of a grain of an earlier thread and an own grain
    Halo halo;                         // copies of other threads' grains
    Loaded loaded;                     // which own grains have contacts

    bool owns(std::int32_t grain) const { return grain >= begin && grain < end; }

    // Sets the thread's own grains and finds its pairs in the new neighbour lists. The halo then needs all
    // listed neighbours, which are more than it needs after any refresh.
    void own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t first_own,
             std::int32_t end_own);
    // Call this after a refresh. From then on the thread reads only those grains of other threads that its
    // contacts and candidates need.
    void list_foreign(const ContactRules& rules, Grains& grains, const Shares& shares);
    // The indices at which to read the bodies of `count` contacts of a group from c on. They are valid until
    // the next call.
    Halo::Bodies bodies_of(const ContactRules& rules, std::size_t group, std::int32_t c, int count);

    // Marks in `loaded` the own grains of all contacts, or of the contacts [from, to) of a group.
    void note_loaded(const ContactRules& rules);
    void note_loaded(const ContactRules& rules, std::size_t group, std::int32_t from, std::int32_t to);

    // The number of contacts whose first body is an own grain and that no longer touch. They are computed
    // until the next refresh.
    std::int64_t parted() const;

    // Gives the contacts whose first body is an own grain, by group, and the number of steps since the last
    // refresh. Checkpoints need both.
    void keep(std::vector<KeptContacts>& kept) const;
    std::int32_t steps_since_refresh() const { return tables[0].step(); }
    // Takes back the kept contacts of own grains.
    void restore(const ContactRules& rules, const std::vector<KeptContacts>& kept, std::int32_t steps);
};

}  // namespace grainreel
