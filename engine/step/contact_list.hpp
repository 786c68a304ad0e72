// Listed pairs of one law so close that they may touch before the next refresh, and the histories of those
// that do. The same list serves grains near walls.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "engine/step/history_rows.hpp"

namespace grainreel {

struct alignas(64) Block {
    double value[kBlock];
};

// Contacts as they are handed from old lists to new ones, and to checkpoints: those with a history only.
struct KeptContacts {
    std::vector<std::int32_t> first, second;  // of a wall contact: grain, face
    std::vector<double> history;              // contact by contact

    std::size_t size() const { return first.size(); }
    void clear() { first.clear(), second.clear(), history.clear(); }
    void append(const KeptContacts& more);
};

// A slot is a contact's place among the thread's listed pairs, or its listed grains at walls. Histories
// belong to slots, so that a refresh leaves them where they are.
class ContactList {
  public:
    // By rising slot. Filled up to a multiple of kBlock, so that whole registers can be read.
    std::vector<std::int32_t> first, second;  // of a wall contact: grain, face
    std::vector<std::int32_t> kind;           // row of the law's parameters; empty where there is only one

    std::int32_t size() const { return size_; }  // without the fill

    // New neighbour lists with so many slots: no contact has a history.
    void renumber(std::int32_t slots, int history_size, std::size_t number_size);

    // A new list: begin(), then add() or leave() for each slot, rising, then end().
    void begin();
    void add(std::int32_t slot, std::int32_t i, std::int32_t j) {
        slot_.push_back(slot), first.push_back(i), second.push_back(j);
    }
    void leave(std::int32_t slot) {
        if (row_of_slot_[slot] != HistoryRows::kNone) give_back(slot);
    }
    void end();

    // Of the 64 contacts from c on, a multiple of 64: which touch now; the others lose their histories.
    void note_touching(std::int32_t c, std::uint64_t touching) {
        for (std::uint64_t ended = touched_[c / 64] & ~touching; ended != 0; ended &= ended - 1)
            leave(slot_[c + std::countr_zero(ended)]);
        touched_[c / 64] = touching;
    }
    // The contact's row of history; one of zeros where it has none.
    std::int32_t row(std::int32_t c) const { return row_of_slot_[slot_[c]]; }
    std::int32_t row_to_write(std::int32_t c) {
        const std::int32_t slot = slot_[c];
        return row_of_slot_[slot] != HistoryRows::kNone ? row_of_slot_[slot] : take_row(slot);
    }
    HistoryRows& rows() { return rows_; }
    const HistoryRows& rows() const { return rows_; }

    // Appends the contacts that have a history and whose first grain is no lower than `begin`.
    void keep(KeptContacts& kept, std::int32_t begin) const;
    // Takes back one of them, numbered as the grains are now. False when the list does not have it.
    bool restore(std::int32_t i, std::int32_t j, const double* numbers);

  private:
    std::int32_t take_row(std::int32_t slot);
    void give_back(std::int32_t slot) {
        rows_.give_back(row_of_slot_[slot]);
        row_of_slot_[slot] = HistoryRows::kNone;
    }

    std::int32_t size_ = 0;
    std::vector<std::int32_t> slot_, row_of_slot_;
    std::vector<std::uint64_t> touched_;  // a bit a contact: it has a history
    HistoryRows rows_;
    std::int32_t found_ = 0;  // where restore() looks first: contacts come back in nearly their old order
};

}  // namespace grainreel
