#include "engine/step/halo.hpp"

#include <algorithm>
#include <cstring>

#include "engine/base/prefetch.hpp"
#include "engine/laws/law_kernel.hpp"

namespace grainreel {

namespace {

// Numbers of a grain in a box: its position, and its motion in doubles or as mixed precision reads it.
constexpr int kPosition = 3;
int numbers_of(const Grains& grains) {
    constexpr int kDoubles = 6, kFloats = sizeof(RoundedMotion) / sizeof(double);
    return kPosition + (grains.rounded.empty() ? kDoubles : kFloats);
}
constexpr int kMostNumbers = kPosition + 6;

}  // namespace

void Halo::own(std::int32_t begin, std::int32_t end, std::int32_t reach, std::int32_t grains) {
    begin_ = begin;
    end_ = end;
    lowest_ = std::max(0, begin - reach);
    slot_.assign(begin - lowest_ + std::min(reach, grains - end), kNone);
    foreign_.clear();
}

void Halo::begin_list() {
    for (const std::int32_t i : foreign_) slot_[place_in_slots(i)] = kNone;
    foreign_.clear();
}

// A little more, or each new list would ask for memory.
void Halo::make_room(std::int32_t at) {
    at_ = at;
    const std::size_t room = foreign_.size() + foreign_.size() / 4 + kBlock;
    if (foreign_.capacity() >= foreign_.size() + kBlock) return;
    foreign_.reserve(room);
    for (auto& box : box_) box.reserve(room * kMostNumbers / 8 + 1);
}

void Halo::end_list(Grains& grains, const Shares& shares) {
    std::sort(foreign_.begin(), foreign_.end());
    part_.clear();
    for (const std::int32_t share : shares) {
        part_.push_back(static_cast<std::int32_t>(std::lower_bound(foreign_.begin(), foreign_.end(), share) -
                                                  foreign_.begin()));
    }
    for (auto& box : box_) box.resize(foreign_.size() * kMostNumbers / 8 + 1);
    for (std::int32_t k = 0; k < size(); ++k) {
        const std::int32_t i = foreign_[k], copy = at_ + k;
        slot_[place_in_slots(i)] = copy;
        grains.place.data()[copy] = grains.place[i];
        grains.motion.data()[copy] = grains.motion[i];
        grains.load.data()[copy] = {};
    }
}

// A line that the reader has had must be taken back from it, which is three times as fast if asked for ahead.
void Halo::put(const Grains& grains, int owner, int box) {
    constexpr int kAhead = 16 * 8;
    const int numbers = numbers_of(grains);
    double* const begin = box_[box].data()->number;
    for (std::int32_t k = part_[owner]; k < part_[owner + 1]; ++k) {
        double* const to = begin + static_cast<std::ptrdiff_t>(k) * numbers;
        fetch_to_write(to + kAhead);
        const std::int32_t i = foreign_[k];
        std::memcpy(to, grains.place[i].position.data(), kPosition * sizeof(double));
        if (!grains.rounded.empty()) {
            std::memcpy(to + kPosition, &grains.rounded[i], sizeof(RoundedMotion));
            continue;
        }
        std::memcpy(to + kPosition, grains.motion[i].velocity.data(), 3 * sizeof(double));
        std::memcpy(to + kPosition + 3, grains.motion[i].spin.data(), 3 * sizeof(double));
    }
}

void Halo::get(Grains& grains, int box) {
    const int numbers = numbers_of(grains);
    const double* from = box_[box].data()->number;
    for (std::int32_t copy = at_; copy < at_ + size(); ++copy, from += numbers) {
        std::memcpy(grains.place.data()[copy].position.data(), from, kPosition * sizeof(double));
        if (!grains.rounded.empty()) {
            std::memcpy(&grains.rounded.data()[copy], from + kPosition, sizeof(RoundedMotion));
            continue;
        }
        Motion& motion = grains.motion.data()[copy];
        std::memcpy(motion.velocity.data(), from + kPosition, 3 * sizeof(double));
        std::memcpy(motion.spin.data(), from + kPosition + 3, 3 * sizeof(double));
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
        first_[c] = slot(first[c]);
        second_[c] = slot(second[c]);
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
