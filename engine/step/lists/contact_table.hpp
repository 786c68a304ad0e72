// The contacts of one law under one thread: by rising first and second body, then, behind these and some
// empty places, the late ones, which began since the last sort(). A contact that has parted keeps its place,
// without a force or a history, until then. Beside them the candidates: pairs so close that they may touch
// before the next refresh. The same table serves grains at walls.
//
// Why not one list of all near pairs, whose histories stay where they are: a law wants what touches side by
// side, and packing that anew each step cost a third of the contact pass (docs/notes/performance.md).
#pragma once

#include <cstdint>
#include <iterator>
#include <vector>

#include "engine/step/grid/reorder.hpp"
#include "engine/step/lists/histories.hpp"

namespace grainreel {

// Contacts as they are handed from thread to thread, and to checkpoints.
struct KeptContacts {
    std::vector<std::int32_t> first, second;  // of a wall contact: grain, face
    std::vector<std::int32_t> tag;            // the thread it is for; to checkpoints: ContactTable::age()
    std::vector<double> history;              // contact by contact

    std::size_t size() const { return first.size(); }
    void clear() { first.clear(), second.clear(), tag.clear(), history.clear(); }
    void append(const KeptContacts& more);
};

class ContactTable {
  public:
    // No contacts; histories of so many numbers.
    void shape(int history_size, std::size_t number_size);

    // The contacts in order are [0, sorted()), the late ones [late(), size()); behind both stands more to
    // fill a block, so that whole registers can be read. Empty places do not touch.
    std::int32_t sorted() const { return sorted_; }
    std::int32_t late() const { return (sorted_ + 63) / 64 * 64; }
    std::int32_t size() const { return size_; }
    const std::int32_t* first() const { return first_.data(); }
    const std::int32_t* second() const { return second_.data(); }
    Histories& histories() { return histories_; }
    const Histories& histories() const { return histories_; }
    // Of the 64 from c on, a multiple of 64: those that touch.
    void note_touching(std::int32_t c, std::uint64_t touching) { touching_[c / 64] = touching; }
    std::uint64_t touching(std::int32_t c) const { return touching_[c / 64]; }

    // Drops what does not touch and sorts the rest; candidates are void.
    void sort();

    // New candidates: begin_candidates(), then offer() pairs by rising i and j, then end_candidates(). A pair
    // that has its place among the contacts is none.
    void begin_candidates();
    void offer(std::int32_t i, std::int32_t j) {
        if (candidates_ == std::ssize(near_second_)) make_room_for_candidates();
        // No branch to mispredict: every pair is written, and the next one overwrites what is a contact.
        near_first_[candidates_] = i, near_second_[candidates_] = j;
        candidates_ += !holds(i, j);
    }
    void end_candidates();
    std::int32_t candidates() const { return candidates_; }
    const std::int32_t* near_first() const { return near_first_.data(); }
    const std::int32_t* near_second() const { return near_second_.data(); }

    // One step's beginning contacts: begin_step(), admit() for each 64 candidates, end_step().
    void begin_step() { ++step_; }
    void admit(std::int32_t c, std::uint64_t touching) {
        if (const std::uint64_t news = touching & ~admitted_[c / 64]; news != 0) add_candidates(c, news);
    }
    std::int32_t end_step();  // the first of them; size() for none
    // Of the 64 candidates from c on: those that have become contacts.
    std::uint64_t admitted(std::int32_t c) const { return admitted_[c / 64]; }

    // Renumbers the bodies of contact c; one that the thread no longer has to do with is dropped by sort().
    void renumber(std::int32_t c, std::int32_t i, std::int32_t j) { first_[c] = i, second_[c] = j; }
    void forget_order() { sorted_ = 0; }
    void drop(std::int32_t c) { touching_[c / 64] &= ~(std::uint64_t{1} << c % 64); }
    bool touches(std::int32_t c) const { return touching_[c / 64] >> c % 64 & 1; }

    // Appends contact c to `kept`, or takes contact k of it.
    void keep(std::int32_t c, std::int32_t tag, KeptContacts& kept) const;
    void take(const KeptContacts& kept, std::size_t k);
    // For checkpoints: at which step since the last sort() contact c began, ~ that if it has parted.
    std::int32_t age(std::int32_t c) const;
    static std::int32_t began(std::int32_t age) { return age < 0 ? ~age : age; }
    // Takes back contact k of those kept with their age as tag: all, in the order of it, first and second.
    void restore(const KeptContacts& kept, std::size_t k);
    void end_restore(std::int32_t step);
    std::int32_t step() const { return step_; }

    // work(begin, end): the stretches of contacts without empty places, the late ones first.
    template <class Work>
    void each_stretch(const Work& work) const {
        work(late(), size_);
        work(0, sorted_);
    }

  private:
    void add(std::int32_t i, std::int32_t j);
    void reserve(std::size_t room);
    void make_room_for_candidates();
    void add_candidates(std::int32_t c, std::uint64_t which);
    static std::uint64_t key(std::int32_t i, std::int32_t j) {
        return std::uint64_t{static_cast<std::uint32_t>(i)} << 32 | static_cast<std::uint32_t>(j);
    }
    // Asked for rising pairs.
    bool holds(std::int32_t i, std::int32_t j) {
        const std::uint64_t pair = key(i, j);
        while (cursor_ < sorted_ && key(first_[cursor_], second_[cursor_]) < pair) ++cursor_;  // hardly ever
        const bool found = cursor_ < sorted_ && key(first_[cursor_], second_[cursor_]) == pair;
        cursor_ += found;
        return found || holds_late(i, j);
    }
    bool holds_late(std::int32_t i, std::int32_t j) const {  // of a loaded checkpoint only
        for (std::int32_t c = sorted_; c < size_; ++c) {
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
    std::vector<std::uint64_t> touching_;  // a bit a contact

    std::int32_t candidates_ = 0;
    LargeArray<std::int32_t> near_first_, near_second_;
    std::vector<std::uint64_t> admitted_;  // a bit a candidate
    std::int32_t cursor_ = 0;              // the first contact that may be offered next

    struct Batch {
        std::int32_t from, step;
    };
    std::vector<Batch> batches_;  // of contacts that began since the last sort
    std::int32_t step_ = 0;

    LargeArray<std::int32_t> young_;  // while sorting: contacts that began since the last one
    Reorder reorder_;
};

}  // namespace grainreel
