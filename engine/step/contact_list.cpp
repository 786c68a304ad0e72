#include "engine/step/contact_list.hpp"

#include <algorithm>
#include <utility>

namespace grainreel {

void KeptContacts::append(const KeptContacts& more) {
    first.insert(first.end(), more.first.begin(), more.first.end());
    second.insert(second.end(), more.second.begin(), more.second.end());
    history.insert(history.end(), more.history.begin(), more.history.end());
}

void ContactList::begin() {
    old_slot_.swap(slot_);
    std::swap(old_history_, history_);
    old_size_ = size_;
    slot_.clear();
    first.clear();
    second.clear();
}

void ContactList::fill_up() {
    size_ = static_cast<std::int32_t>(first.size());
    while (first.size() % kBlock != 0) add(slot_.back(), first.back(), second.back());
    kind.resize(first.size());
    mass_.resize(first.size() / kBlock);
    radius_.resize(first.size() / kBlock);
    found_ = 0;
}

void ContactList::end(bool carry_histories, int history_size, std::size_t number_size) {
    fill_up();
    history_.reset(first.size(), history_size, number_size);
    if (!carry_histories) return;
    std::int32_t old = 0;
    for (std::int32_t c = 0; c < size_; ++c) {
        while (old < old_size_ && old_slot_[old] < slot_[c]) ++old;
        if (old == old_size_ || old_slot_[old] != slot_[c]) continue;
        for (int k = 0; k < history_size; ++k) history_.set(c, k, old_history_.get(old, k));
    }
}

void ContactList::keep(KeptContacts& kept, std::int32_t begin) const {
    for (std::int32_t c = 0; c < size_; ++c) {
        if (first[c] < begin) continue;
        bool any = false;
        for (int k = 0; k < history_.numbers() && !any; ++k) any = history_.get(c, k) != 0;
        if (!any) continue;
        kept.first.push_back(first[c]);
        kept.second.push_back(second[c]);
        for (int k = 0; k < history_.numbers(); ++k) kept.history.push_back(history_.get(c, k));
    }
}

bool ContactList::restore(std::int32_t i, std::int32_t j, const double* numbers) {
    while (found_ < size_ && first[found_] < i) ++found_;
    while (found_ > 0 && first[found_ - 1] >= i) --found_;
    std::int32_t c = found_;
    while (c < size_ && first[c] == i && second[c] != j) ++c;
    if (c == size_ || first[c] != i) return false;
    for (int k = 0; k < history_.numbers(); ++k) history_.set(c, k, numbers[k]);
    return true;
}

}  // namespace grainreel
