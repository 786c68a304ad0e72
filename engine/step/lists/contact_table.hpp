// The contacts of one law under one thread. First come the sorted contacts, by rising first and second body.
// After these and some empty places come the late contacts, which began since the last sort(). A contact that
// has parted keeps its place until the next sort(), without a force or a history.
//
// The table also holds the candidates: pairs that are so close that they may touch before the next refresh.
// The same table serves grains at walls.
//
// One list of all near pairs, with the histories in fixed places, would be simpler. But a law needs the
// touching contacts side by side, and packing them in each step cost a third of the contact pass
// (docs/notes/performance.md).
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "engine/step/lists/histories.hpp"

namespace grainreel {

// Contacts on their way from thread to thread, or to a checkpoint.
struct KeptContacts {
    std::vector<std::int32_t> first, second;  // the two bodies; for a wall contact grain and face
    std::vector<std::int32_t> tag;            // the thread to go to; in checkpoints: ContactTable::age()
    std::vector<double> history;              // contact by contact

    std::size_t size() const { return first.size(); }
    void clear() { first.clear(), second.clear(), tag.clear(), history.clear(); }
    void append(const KeptContacts& more);
};

class ContactTable {
  public:
    // Empties the table. Histories will have `history_size` numbers of `number_size` bytes each.
    void shape(int history_size, std::size_t number_size);

    // The sorted contacts are [0, sorted()), the late ones [late(), size()). After both, copies fill the last
    // block, so that whole registers can be read. Empty places do not touch.
    std::int32_t sorted() const { return sorted_; }
    std::int32_t late() const { return (sorted_ + 63) / 64 * 64; }
    std::int32_t size() const { return size_; }
    const std::int32_t* first() const { return first_.data(); }
    const std::int32_t* second() const { return second_.data(); }
    Histories& histories() { return histories_; }
    const Histories& histories() const { return histories_; }
    // One bit for each of the 64 contacts from c on: whether it touches. c is a multiple of 64.
    void note_touching(std::int32_t c, std::uint64_t touching) { touching_[c / 64] = touching; }
    std::uint64_t touching(std::int32_t c) const { return touching_[c / 64]; }

    // Drops the contacts that do not touch and sorts the rest. The candidates become invalid.
    void sort();

    // Sets new candidates: call begin_candidates(), then offer() for each pair by rising i and j, then
    // end_candidates(). A pair that is among the contacts does not become a candidate.
    void begin_candidates();
    void offer(std::int32_t i, std::int32_t j) {
        if (candidates_ == std::ssize(near_second_)) make_room_for_candidates();
        // There is no branch to mispredict: every pair is written, and if it is a contact, the next pair
        // overwrites it.
        near_first_[candidates_] = i, near_second_[candidates_] = j;
        candidates_ += !holds(i, j);
    }
    void end_candidates();
    std::int32_t candidates() const { return candidates_; }
    const std::int32_t* near_first() const { return near_first_.data(); }
    const std::int32_t* near_second() const { return near_second_.data(); }

    // Adds the contacts that begin in a step: call begin_step(), then admit() for each 64 candidates, then
    // end_step().
    void begin_step() { ++step_; }
    void admit(std::int32_t c, std::uint64_t touching) {
        if (const std::uint64_t news = touching & ~admitted_[c / 64]; news != 0) add_candidates(c, news);
    }
    // Adds a contact that was no candidate, and returns its place. Contacts of one step must come by
    // rising bodies.
    std::int32_t add_new(std::int32_t i, std::int32_t j);
    std::int32_t end_step();  // the first contact that began; size() if none did
    // One bit for each of the 64 candidates from c on: whether it has become a contact.
    std::uint64_t admitted(std::int32_t c) const { return admitted_[c / 64]; }

    // renumber() gives the bodies of contact c new numbers. drop() marks a contact as parted, and the next
    // sort() removes it. After forget_order() all contacts count as unsorted.
    void renumber(std::int32_t c, std::int32_t i, std::int32_t j) { first_[c] = i, second_[c] = j; }
    void forget_order() { sorted_ = 0; }
    void drop(std::int32_t c) { touching_[c / 64] &= ~(std::uint64_t{1} << c % 64); }
    // The place of a contact, or -1.
    std::int32_t place_of(std::int32_t i, std::int32_t j) const;
    bool touches(std::int32_t c) const { return touching_[c / 64] >> c % 64 & 1; }

    // keep() appends contact c to `kept`; take() adds contact k of `kept` to the table.
    void keep(std::int32_t c, std::int32_t tag, KeptContacts& kept) const;
    void take(const KeptContacts& kept, std::size_t k);
    // Calls history_of(first, second, numbers) for each contact that touches; if it returns true, the first
    // `size` numbers become the contact's history.
    template <class HistoryOf>
    void take_histories(int size, const HistoryOf& history_of) {
        double numbers[Histories::kMostNumbers];
        each_stretch([&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t c = begin; c < end; ++c) {
                if (!touches(c) || !history_of(first_[c], second_[c], numbers)) continue;
                for (int k = 0; k < size; ++k) histories_.set(c, k, numbers[k]);
            }
        });
    }
    // The step in which contact c began, counted from the last sort(), for checkpoints; 0 for sorted
    // contacts. The bits are inverted (~) if the contact has parted.
    std::int32_t age(std::int32_t c) const;
    static std::int32_t began(std::int32_t age) { return age < 0 ? ~age : age; }
    // restore() adds contact k of `kept`, whose tag is its age. Contacts must come in the order of age, first
    // and second body. Call end_restore() after the last one.
    void restore(const KeptContacts& kept, std::size_t k);
    void end_restore(std::int32_t step);
    std::int32_t step() const { return step_; }

    // Calls work(begin, end) for each stretch of contacts without empty places. The late ones come first.
    template <class Work>
    void each_stretch(const Work& work) const {
        work(late(), size_);
        work(0, sorted_);
    }
    // Calls work(c, count) for each chunk of up to kChunk contacts without empty places, in the same order.
    template <class Work>
    void each_chunk(const Work& work) const {
        struct Stretch {
            std::int32_t begin, end;
        };
        for (const Stretch stretch : {Stretch{late(), size_}, Stretch{0, sorted_}}) {
            for (std::int32_t c = stretch.begin; c < stretch.end; c += kChunk)
                work(c, std::min(kChunk, stretch.end - c));
        }
    }

  private:
    void add(std::int32_t i, std::int32_t j);
    void reserve(std::size_t room);
    void make_room_for_candidates();
    void begin_batch();
    void add_candidates(std::int32_t c, std::uint64_t which);
    static std::uint64_t key(std::int32_t i, std::int32_t j) {
        return std::uint64_t{static_cast<std::uint32_t>(i)} << 32 | static_cast<std::uint32_t>(j);
    }
    // Whether the pair is among the contacts. Callers ask for rising pairs.
    bool holds(std::int32_t i, std::int32_t j) {
        const std::uint64_t pair = key(i, j);
        while (cursor_ < sorted_ && key(first_[cursor_], second_[cursor_]) < pair) ++cursor_;  // hardly ever
        const bool found = cursor_ < sorted_ && key(first_[cursor_], second_[cursor_]) == pair;
        cursor_ += found;
        return found || holds_late(i, j);
    }
    // sort() leaves no late contacts. So there are some here only when candidates are listed after a
    // checkpoint was loaded. The empty places before them hold any bodies.
    bool holds_late(std::int32_t i, std::int32_t j) const {
        for (std::int32_t c = late(); c < size_; ++c) {
            if (first_[c] == i && second_[c] == j) return true;
        }
        return false;
    }
    bool before(std::int32_t a, std::int32_t b) const {
        return first_[a] != first_[b] ? first_[a] < first_[b] : second_[a] < second_[b];
    }
    void order_contacts(LargeArray<std::int32_t>& order);
    void permute(const LargeArray<std::int32_t>& order);
    void fill_up();

    std::int32_t size_ = 0, sorted_ = 0;
    LargeArray<std::int32_t> first_, second_;
    Histories histories_;
    std::vector<std::uint64_t> touching_;  // one bit for each contact

    std::int32_t candidates_ = 0;
    LargeArray<std::int32_t> near_first_, near_second_;
    std::vector<std::uint64_t> admitted_;  // one bit for each candidate
    std::int32_t cursor_ =
        0;  // sorted contacts before this one come before all pairs that are still to be offered

    struct Batch {
        std::int32_t from, step;
    };
    std::vector<Batch> batches_;  // contacts that began since the last sort, one batch for each step
    std::int32_t step_ = 0;

    LargeArray<std::int32_t> young_;  // while sorting: contacts that began since the last one
    Reorder reorder_;
};

}  // namespace grainreel
