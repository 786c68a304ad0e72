// The contacts a thread works on: listed pairs so close that they may touch before the next refresh, with
// their histories, ready for the laws. The same list serves grains near walls.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/step/histories.hpp"

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

class ContactList {
  public:
    // All of equal length, a multiple of kBlock: the last contact is repeated to fill it. By rising first.
    std::vector<std::int32_t> first, second;  // of a wall contact: grain, face
    std::vector<std::int32_t> kind;           // row of the law's parameters

    std::int32_t size() const { return size_; }                                      // without the fill
    std::int32_t filled() const { return static_cast<std::int32_t>(first.size()); }  // with it

    // Of the block of contacts that starts with `contact`, laid out as LawKernel and LawInput have it.
    void* history_of_block(std::int32_t contact) { return history_.of_block(contact); }
    const void* history_of_block(std::int32_t contact) const { return history_.of_block(contact); }
    const double* mass_of_block(std::int32_t contact) const { return mass_[contact / kBlock].value; }
    const double* radius_of_block(std::int32_t contact) const { return radius_[contact / kBlock].value; }
    void set_effective(std::int32_t contact, double mass, double radius) {
        mass_[contact / kBlock].value[contact % kBlock] = mass;
        radius_[contact / kBlock].value[contact % kBlock] = radius;
    }

    // A new list: begin(), then add() by rising slot, then end(). A slot is the contact's place in the
    // neighbour list; where that is the same as at the last refresh, histories follow their slot.
    void begin();
    void add(std::int32_t slot, std::int32_t i, std::int32_t j) {
        slot_.push_back(slot), first.push_back(i), second.push_back(j);
    }
    void end(bool carry_histories, int history_size, std::size_t number_size);

    // Appends the contacts that have a history and whose first grain is no lower than `begin`.
    void keep(KeptContacts& kept, std::int32_t begin) const;
    // Takes back one of them, numbered as the grains are now. False when the list does not have it.
    bool restore(std::int32_t i, std::int32_t j, const double* numbers);

  private:
    void fill_up();

    std::int32_t size_ = 0;
    std::vector<std::int32_t> slot_, old_slot_;
    Histories history_, old_history_;
    std::vector<Block> mass_, radius_;  // kg, m: effective ones
    std::int32_t old_size_ = 0;
    std::int32_t found_ = 0;  // where restore() looks first: contacts come back in nearly their old order
};

}  // namespace grainreel
