// Brings the numbers of contacts into a new order. Most contacts that stood side by side still do so in the
// new order, and are moved a block at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/base/large_array.hpp"
#include "engine/laws/law_kernel.hpp"

namespace grainreel {

class Reorder {
  public:
    void reserve(std::size_t contacts) {
        together_.reserve(contacts / kBlock + 1);
        room_.reserve(contacts / kLine + 2);
    }
    // Contact order[c] is to move to place c. `order` must outlive the moves.
    void set(const LargeArray<std::int32_t>& order) {
        order_ = order.data();
        count_ = static_cast<std::int32_t>(order.size());
        together_.clear();
        unchanged_ = 0;
        for (std::int32_t c = 0; c + kBlock <= count_; c += kBlock) {
            std::int32_t apart = 0;
            for (int k = 1; k < kBlock; ++k) apart |= (order_[c + k] - order_[c]) ^ k;
            together_.push_back(apart == 0);
            if (apart == 0 && order_[c] == c && unchanged_ == c) unchanged_ += kBlock;
        }
        together_.push_back(false);
    }
    // Moves one number of each contact. There were `before` contacts in the old order. block(c) says where
    // the numbers of the kBlock contacts from c on lie; c is a multiple of kBlock.
    template <class Number, class Block>
    void move(std::int32_t before, const Block& block) {
        constexpr std::int32_t kAhead = 8 * kBlock;  // the processor cannot foresee the next block
        constexpr std::size_t size = sizeof(Number);
        room_.resize((before - unchanged_) / kLine + 2);
        const auto room = [&](std::int32_t c) { return room_.data()->bytes + (c - unchanged_) * size; };
        for (std::int32_t c = unchanged_; c < before; c += kBlock) {
            __builtin_prefetch(block(std::min(c + kAhead, before - 1) / kBlock * kBlock));
            std::memcpy(room(c), block(c), kBlock * size);
        }
        for (std::int32_t c = unchanged_; c < count_; c += kBlock) {
            std::byte* to = block(c);
            if (together_[c / kBlock]) {
                std::memcpy(to, room(order_[c]), kBlock * size);
                continue;
            }
            for (int k = 0; k < std::min(kBlock, count_ - c); ++k)
                std::memcpy(to + k * size, room(order_[c + k]), size);
        }
    }

  private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    static constexpr std::int32_t kLine = sizeof(Line) / sizeof(double);  // numbers, the largest there are

    const std::int32_t* order_ = nullptr;
    std::int32_t count_ = 0, unchanged_ = 0;  // the first `unchanged_` stay; a multiple of kBlock
    std::vector<std::uint8_t> together_;      // whether the contacts of a block stood side by side
    LargeArray<Line> room_;
};

}  // namespace grainreel
