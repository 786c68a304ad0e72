#include "engine/step/contact_list.hpp"

#include <algorithm>

namespace grainreel {

void KeptContacts::append(const KeptContacts& more) {
    first.insert(first.end(), more.first.begin(), more.first.end());
    second.insert(second.end(), more.second.begin(), more.second.end());
    history.insert(history.end(), more.history.begin(), more.history.end());
}

void ContactList::begin(int history_size) {
    history_size_ = history_size;
    old_slot_.swap(slot_);
    old_history_.swap(history_);
    old_size_ = size_;
    slot_.clear();
    first.clear();
    second.clear();
}

void ContactList::fill_up() {
    size_ = static_cast<std::int32_t>(first.size());
    while (first.size() % kBlock != 0) add(slot_.back(), first.back(), second.back());
    history_.assign(first.size() / kBlock * history_size_, Block{});
    kind.resize(first.size());
    mass_.resize(first.size() / kBlock);
    radius_.resize(first.size() / kBlock);
    found_ = 0;
}

void ContactList::end(bool carry_histories) {
    fill_up();
    if (!carry_histories) return;
    std::int32_t old = 0;
    for (std::int32_t c = 0; c < size_; ++c) {
        while (old < old_size_ && old_slot_[old] < slot_[c]) ++old;
        if (old == old_size_ || old_slot_[old] != slot_[c]) continue;
        const Block* from = &old_history_[old / kBlock * history_size_];
        for (int k = 0; k < history_size_; ++k) number(c, k) = from[k].value[old % kBlock];
    }
}

void ContactList::keep(KeptContacts& kept, std::int32_t begin) const {
    for (std::int32_t c = 0; c < size_; ++c) {
        if (first[c] < begin) continue;
        bool any = false;
        for (int k = 0; k < history_size_ && !any; ++k) any = number(c, k) != 0;
        if (!any) continue;
        kept.first.push_back(first[c]);
        kept.second.push_back(second[c]);
        for (int k = 0; k < history_size_; ++k) kept.history.push_back(number(c, k));
    }
}

bool ContactList::restore(std::int32_t i, std::int32_t j, const double* numbers) {
    while (found_ < size_ && first[found_] < i) ++found_;
    while (found_ > 0 && first[found_ - 1] >= i) --found_;
    std::int32_t c = found_;
    while (c < size_ && first[c] == i && second[c] != j) ++c;
    if (c == size_ || first[c] != i) return false;
    for (int k = 0; k < history_size_; ++k) number(c, k) = numbers[k];
    return true;
}

}  // namespace grainreel
