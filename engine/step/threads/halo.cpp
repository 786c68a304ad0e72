#include "engine/step/threads/halo.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "engine/base/system/processor.hpp"
#include "engine/laws/law_kernel.hpp"

namespace grainreel {

namespace {

// The number of doubles that a grain takes in a box: its position, and its motion in doubles or in floats.
constexpr int kPosition = 3;
int numbers_of(const Grains& grains) {
    constexpr int kDoubles = 6, kFloats = sizeof(RoundedMotion) / sizeof(double);
    return kPosition + (grains.rounded.empty() ? kDoubles : kFloats);
}
constexpr int kMostNumbers = kPosition + 6;
constexpr int kBits = 64;  // bits of a word
constexpr std::int32_t words_for(std::int32_t count) {
    return (count + kBits - 1) / kBits;
}
constexpr std::int32_t lines_for(std::int32_t count) {
    return (words_for(count) + count * kMostNumbers + 7) / 8;
}

bool all_come(const double* words, std::int32_t count) {
    std::int32_t come = 0;
    for (std::int32_t w = 0; w < words_for(count); ++w) {
        std::uint64_t word;
        std::memcpy(&word, words + w, sizeof word);
        come += std::popcount(word);
    }
    return come == count;
}

void set_copy(Grains& grains, std::int32_t copy, const double* from) {
    std::memcpy(grains.place.data()[copy].position.data(), from, kPosition * sizeof(double));
    if (!grains.rounded.empty()) {
        std::memcpy(&grains.rounded.data()[copy], from + kPosition, sizeof(RoundedMotion));
        return;
    }
    Motion& motion = grains.motion.data()[copy];
    std::memcpy(motion.velocity.data(), from + kPosition, 3 * sizeof(double));
    std::memcpy(motion.spin.data(), from + kPosition + 3, 3 * sizeof(double));
}

}  // namespace

void Halo::own(std::int32_t begin, std::int32_t end, std::int32_t reach, std::int32_t grains) {
    begin_ = begin;
    end_ = end;
    lowest_ = std::max(0, begin - reach);
    slot_.clear();
    foreign_.clear();
    if (end - begin == grains) return;
    slot_.assign(std::min(grains - end, reach) + end - lowest_, kNone);
    std::iota(slot_.begin() + (begin - lowest_), slot_.begin() + (end - lowest_), begin);
}

void Halo::begin_list() {
    for (const std::int32_t i : foreign_) slot_[i - lowest_] = kNone;
    foreign_.clear();
}

void Halo::need(const std::int32_t* first, const std::int32_t* second, std::int32_t count) {
    for (std::int32_t c = 0; c < count; c += kChunk) {
        const int many = std::min(kChunk, count - c);
        if (all_own(first + c, second + c, many)) continue;
        for (std::int32_t k = c; k < c + many; ++k) need(first[k]), need(second[k]);
    }
}

// Makes a little more room than needed. Otherwise each new list would ask for memory.
void Halo::make_room(std::int32_t at, int owners) {
    at_ = at;
    const std::size_t room = foreign_.size() + foreign_.size() / 4 + kBlock;
    if (foreign_.capacity() >= foreign_.size() + kBlock) return;
    foreign_.reserve(room);
    for (auto& box : box_) box.reserve(lines_for(static_cast<std::int32_t>(room)) + 2 * owners);
}

void Halo::end_list(Grains& grains, const Shares& shares) {
    std::sort(foreign_.begin(), foreign_.end());
    part_.clear();
    std::int32_t at = 0, line = 0;
    for (std::size_t owner = 0; owner + 1 < shares.size(); ++owner) {
        const auto next = std::lower_bound(foreign_.begin() + at, foreign_.end(), shares[owner + 1]);
        const auto end = static_cast<std::int32_t>(next - foreign_.begin());
        part_.push_back({at, end, line});
        line += lines_for(end - at);
        at = end;
    }
    for (auto& box : box_) box.resize(line);
    for (std::int32_t k = 0; k < size(); ++k) {
        slot_[foreign_[k] - lowest_] = at_ + k;
        grains.load.data()[at_ + k] = {};
    }
    copy(grains);
}

void Halo::copy(Grains& grains) const {
    for (std::int32_t k = 0; k < size(); ++k) {
        const std::int32_t i = foreign_[k], copy = at_ + k;
        grains.place.data()[copy] = grains.place[i];
        grains.motion.data()[copy] = grains.motion[i];
        if (!grains.rounded.empty()) grains.rounded.data()[copy] = grains.rounded[i];
    }
}

// Before a line is written, this processor must fetch it from the reader's cache. Asking for the line ahead
// makes this three times as fast.
void Halo::put(const Grains& grains, const Loaded* loaded, int owner, int box) {
    constexpr int kAhead = 16 * 8;
    const int numbers = numbers_of(grains);
    const bool all = !loaded || !loaded->few();
    const Part part = part_[owner];
    if (part.begin == part.end) return;
    double* words = box_[box].data()[part.line].number;
    double* to = words + words_for(part.end - part.begin);
    for (std::int32_t k = part.begin; k < part.end; k += kBits, ++words) {
        const int many = std::min(kBits, part.end - k);
        std::uint64_t comes = all ? bits_of_first(many) : 0;
        if (!all)  // no branch for each grain: it would be mispredicted
            for (int bit = 0; bit < many; ++bit)
                comes |= std::uint64_t{loaded->has(foreign_[k + bit])} << bit;
        for (std::uint64_t left = comes; left != 0; left &= left - 1) {
            const std::int32_t i = foreign_[k + std::countr_zero(left)];
            fetch_to_write(to + kAhead);
            std::memcpy(to, grains.place[i].position.data(), kPosition * sizeof(double));
            if (!grains.rounded.empty()) {
                std::memcpy(to + kPosition, &grains.rounded[i], sizeof(RoundedMotion));
            } else {
                std::memcpy(to + kPosition, grains.motion[i].velocity.data(), 3 * sizeof(double));
                std::memcpy(to + kPosition + 3, grains.motion[i].spin.data(), 3 * sizeof(double));
            }
            to += numbers;
        }
        std::memcpy(words, &comes, sizeof comes);
    }
}

void Halo::get(Grains& grains, int box, const FreeFlight& flight) {
    const int numbers = numbers_of(grains);
    for (const Part& part : part_) {
        if (part.begin == part.end) continue;
        const std::int32_t words = words_for(part.end - part.begin);
        const double* word = box_[box].data()[part.line].number;
        const double* from = word + words;
        if (!all_come(word, part.end - part.begin)) fly(grains, flight, at_ + part.begin, at_ + part.end);
        for (std::int32_t k = part.begin; k < part.end; k += kBits, ++word) {
            std::uint64_t comes;
            std::memcpy(&comes, word, sizeof comes);
            for (; comes != 0; comes &= comes - 1, from += numbers)
                set_copy(grains, at_ + k + std::countr_zero(comes), from);
        }
    }
}

bool Halo::all_own(const std::int32_t* first, const std::int32_t* second, int count) const {
    std::int32_t outside = 0;
    for (int c = 0; c < count; ++c) {
        outside |= (first[c] - begin_) | (end_ - 1 - first[c]);
        outside |= (second[c] - begin_) | (end_ - 1 - second[c]);
    }
    return outside >= 0;  // no difference is negative
}

Halo::Bodies Halo::find_foreign(const std::int32_t* first, const std::int32_t* second, int count) {
    for (int c = 0; c < (count + kBlock - 1) / kBlock * kBlock; ++c) {
        first_[c] = slot_[first[c] - lowest_];
        second_[c] = slot_[second[c] - lowest_];
    }
    return {first_, second_};
}

void FoundPairs::set(Halo& halo, const std::int32_t* first, const std::int32_t* second, std::int32_t count) {
    at_.clear(), first_.clear(), second_.clear();
    if (!halo.has_foreign()) return;
    for (std::int32_t c = 0; c < count; c += kChunk) {
        const int many = std::min(kChunk, count - c), filled = (many + kBlock - 1) / kBlock * kBlock;
        const Halo::Bodies bodies = halo.find(first + c, second + c, many);
        const bool as_listed = bodies.first == first + c;
        at_.push_back(as_listed ? kAsListed : static_cast<std::int32_t>(first_.size()));
        if (as_listed) continue;
        first_.insert(first_.end(), bodies.first, bodies.first + filled);
        second_.insert(second_.end(), bodies.second, bodies.second + filled);
    }
}

void reserve_copies(Grains& grains, std::int32_t count) {
    const auto reserve = [count](auto& array) {
        const std::size_t wanted = array.size() + count;
        if (array.capacity() < wanted) array.reserve(wanted + count / 4);
    };
    if (count == 0) return;
    reserve(grains.place), reserve(grains.motion), reserve(grains.load);
    if (!grains.rounded.empty()) reserve(grains.rounded);
}

}  // namespace grainreel
