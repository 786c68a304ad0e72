#include "engine/step/lists/contact_table.hpp"

#include <algorithm>
#include <bit>

namespace grainreel {

void KeptContacts::append(const KeptContacts& more) {
    first.insert(first.end(), more.first.begin(), more.first.end());
    second.insert(second.end(), more.second.begin(), more.second.end());
    tag.insert(tag.end(), more.tag.begin(), more.tag.end());
    history.insert(history.end(), more.history.begin(), more.history.end());
}

void ContactTable::shape(int history_size, std::size_t number_size) {
    *this = {};
    histories_.shape(history_size, number_size);
    batches_.reserve(256);
}

// Adds a contact that touches and has no history yet.
void ContactTable::add(std::int32_t i, std::int32_t j) {
    if (size_ == sorted_) {
        fill_up();
        size_ = late();
    }
    const std::size_t room = (size_ + kBlock) / kBlock * kBlock;
    if (first_.size() < room) {
        reserve(room);
        first_.resize(room);
        second_.resize(room);
        histories_.resize(static_cast<std::int32_t>(room));
    }
    if (touching_.size() * 64 < room) touching_.push_back(0);
    histories_.clear(size_);
    first_[size_] = i;
    second_[size_] = j;
    touching_[size_ / 64] |= std::uint64_t{1} << size_ % 64;
    ++size_;
}

// Memory grows by a little at a time. Histories are most of a run's memory, and doubling it would leave half
// of it unused.
void ContactTable::reserve(std::size_t room) {
    if (room <= first_.capacity()) return;
    room += (room / 32 + kBlock) / kBlock * kBlock;
    first_.reserve(room);
    second_.reserve(room);
    histories_.reserve(static_cast<std::int32_t>(room));
    reorder_.reserve(room);
    near_second_.reserve(room);
    near_first_.reserve(room);  // while contacts are sorted, it holds their order
    young_.reserve(room / 8);
    touching_.reserve(room / 64 + 1);
}

void ContactTable::make_room_for_candidates() {
    if (near_second_.size() == near_second_.capacity()) {
        const std::size_t room = (near_second_.size() * 9 / 8 + 64) / kBlock * kBlock;
        near_first_.reserve(room);
        near_second_.reserve(room);
    }
    near_second_.resize(near_second_.capacity());
    near_first_.resize(near_second_.size());
}

// Fills the places after the last contact with copies of it, so that everything that is read is valid.
void ContactTable::fill_up() {
    for (std::size_t c = size_; c < first_.size(); ++c) {
        first_[c] = size_ > 0 ? first_[c - 1] : 0;
        second_[c] = size_ > 0 ? second_[c - 1] : 0;
    }
}

void ContactTable::sort() {
    LargeArray<std::int32_t>& order = near_first_;  // the candidates are no longer needed
    order_contacts(order);
    const auto stay = static_cast<std::int32_t>(order.size());
    permute(order);
    size_ = sorted_ = stay;
    step_ = 0;
    batches_.clear();
    const std::size_t room = (size_ + kBlock - 1) / kBlock * kBlock;
    first_.resize(room);
    second_.resize(room);
    histories_.resize(static_cast<std::int32_t>(room));
    touching_.assign((room + 63) / 64, 0);
    for (std::int32_t c = 0; c < size_; ++c) touching_[c / 64] |= std::uint64_t{1} << c % 64;
    fill_up();
}

// Writes the touching contacts into `order`, sorted. The few contacts that began lately are merged into the
// others.
void ContactTable::order_contacts(LargeArray<std::int32_t>& order) {
    const auto less = [this](std::int32_t a, std::int32_t b) { return before(a, b); };
    order.clear();
    young_.clear();
    const bool in_order = sorted_ > 0;
    for (std::int32_t c = 0; c < size_; ++c) {
        if (touches(c)) (c < sorted_ || !in_order ? order : young_).push_back(c);
    }
    if (!in_order) return std::sort(order.begin(), order.end(), less);
    std::sort(young_.begin(), young_.end(), less);
    std::ptrdiff_t old = std::ssize(order) - 1, young = std::ssize(young_) - 1;
    order.resize(order.size() + young_.size());
    for (std::ptrdiff_t to = std::ssize(order) - 1; young >= 0; --to)
        order[to] = old >= 0 && less(young_[young], order[old]) ? order[old--] : young_[young--];
}

// Reorders one array after the other. Contacts that keep their neighbours are then read line after line.
// (Moving them in place, along the cycles of the permutation, took a tenth of the time of a run with a
// million grains.)
void ContactTable::permute(const LargeArray<std::int32_t>& order) {
    reorder_.set(order);
    for (auto* bodies : {&first_, &second_}) {
        reorder_.move<std::int32_t>(
            size_, [&](std::int32_t c) { return reinterpret_cast<std::byte*>(bodies->data() + c); });
    }
    histories_.reorder(reorder_, size_);
}

void ContactTable::begin_candidates() {
    near_first_.resize(near_second_.size());  // sort() has used it for the order
    candidates_ = 0;
    cursor_ = 0;
}

void ContactTable::end_candidates() {
    const std::size_t room = (candidates_ + kBlock - 1) / kBlock * kBlock;
    near_first_.resize(room);
    near_second_.resize(room);
    for (std::size_t c = candidates_; c < room; ++c)
        near_first_[c] = near_first_[c - 1], near_second_[c] = near_second_[c - 1];
    admitted_.assign((candidates_ + 63) / 64, 0);
}

// Call this before a contact that begins in the present step. The first call of a step begins a batch.
void ContactTable::begin_batch() {
    if (batches_.empty() || batches_.back().step != step_) batches_.push_back({size_, step_});
}

std::int32_t ContactTable::add_new(std::int32_t i, std::int32_t j) {
    begin_batch();
    add(i, j);
    return size_ - 1;
}

void ContactTable::add_candidates(std::int32_t c, std::uint64_t which) {
    admitted_[c / 64] |= which;
    begin_batch();
    for (; which != 0; which &= which - 1) {
        const std::int32_t at = c + std::countr_zero(which);
        add(near_first_[at], near_second_[at]);
    }
}

std::int32_t ContactTable::end_step() {
    if (batches_.empty() || batches_.back().step != step_) return size_;
    fill_up();
    return std::max(batches_.back().from, late());
}

std::int32_t ContactTable::place_of(std::int32_t i, std::int32_t j) const {
    std::int32_t low = 0, high = sorted_;
    while (low < high) {
        const std::int32_t middle = low + (high - low) / 2;
        key(first_[middle], second_[middle]) < key(i, j) ? low = middle + 1 : high = middle;
    }
    const auto is = [&](std::int32_t c) { return first_[c] == i && second_[c] == j; };
    if (low < sorted_ && is(low)) return low;
    for (std::int32_t c = late(); c < size_; ++c)
        if (is(c)) return c;
    return -1;
}

void ContactTable::keep(std::int32_t c, std::int32_t tag, KeptContacts& kept) const {
    kept.first.push_back(first_[c]);
    kept.second.push_back(second_[c]);
    kept.tag.push_back(tag);
    for (int k = 0; k < histories_.numbers(); ++k) kept.history.push_back(histories_.get(c, k));
}

void ContactTable::take(const KeptContacts& kept, std::size_t k) {
    add(kept.first[k], kept.second[k]);
    const int numbers = histories_.numbers();
    for (int h = 0; h < numbers; ++h) histories_.set(size_ - 1, h, kept.history[k * numbers + h]);
}

std::int32_t ContactTable::age(std::int32_t c) const {
    const auto later = [](std::int32_t at, const Batch& batch) { return at < batch.from; };
    const auto batch = std::upper_bound(batches_.begin(), batches_.end(), c, later);
    const std::int32_t began = batch == batches_.begin() ? 0 : std::prev(batch)->step;
    return touches(c) ? began : ~began;
}

void ContactTable::restore(const KeptContacts& kept, std::size_t k) {
    const std::int32_t age = kept.tag[k], step = began(age);
    if (step != 0 && batches_.empty()) sorted_ = size_;
    take(kept, k);
    if (step != 0 && (batches_.empty() || batches_.back().step != step))
        batches_.push_back({size_ - 1, step});
    if (age < 0) drop(size_ - 1);
}

void ContactTable::end_restore(std::int32_t step) {
    if (batches_.empty()) sorted_ = size_;
    fill_up();
    step_ = step;
}

}  // namespace grainreel
