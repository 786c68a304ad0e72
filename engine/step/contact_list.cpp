#include "engine/step/contact_list.hpp"

namespace grainreel {

void KeptContacts::append(const KeptContacts& more) {
    first.insert(first.end(), more.first.begin(), more.first.end());
    second.insert(second.end(), more.second.begin(), more.second.end());
    history.insert(history.end(), more.history.begin(), more.history.end());
}

void ContactList::renumber(std::int32_t slots, int history_size, std::size_t number_size) {
    row_of_slot_.assign(slots, HistoryRows::kNone);
    rows_.shape(history_size, number_size);
}

std::int32_t ContactList::take_row(std::int32_t slot) {
    return row_of_slot_[slot] = rows_.take();
}

void ContactList::begin() {
    slot_.clear();
    first.clear();
    second.clear();
}

void ContactList::end() {
    size_ = static_cast<std::int32_t>(first.size());
    while (first.size() % kBlock != 0) add(slot_.back(), first.back(), second.back());
    touched_.assign((size_ + 63) / 64, 0);
    for (std::int32_t c = 0; c < size_; ++c)
        touched_[c / 64] |= std::uint64_t{row(c) != HistoryRows::kNone} << c % 64;
    found_ = 0;
}

void ContactList::keep(KeptContacts& kept, std::int32_t begin) const {
    for (std::int32_t c = 0; c < size_; ++c) {
        const std::int32_t from = row(c);
        if (first[c] < begin || from == HistoryRows::kNone) continue;
        bool any = false;
        for (int k = 0; k < rows_.numbers() && !any; ++k) any = rows_.get(from, k) != 0;
        if (!any) continue;
        kept.first.push_back(first[c]);
        kept.second.push_back(second[c]);
        for (int k = 0; k < rows_.numbers(); ++k) kept.history.push_back(rows_.get(from, k));
    }
}

bool ContactList::restore(std::int32_t i, std::int32_t j, const double* numbers) {
    while (found_ < size_ && first[found_] < i) ++found_;
    while (found_ > 0 && first[found_ - 1] >= i) --found_;
    std::int32_t c = found_;
    while (c < size_ && first[c] == i && second[c] != j) ++c;
    if (c == size_ || first[c] != i) return false;
    const std::int32_t to = row_to_write(c);
    for (int k = 0; k < rows_.numbers(); ++k) rows_.set(to, k, numbers[k]);
    touched_[c / 64] |= std::uint64_t{1} << c % 64;
    return true;
}

}  // namespace grainreel
