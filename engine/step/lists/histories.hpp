// The histories of contacts, in the layout that the kernels of the laws read. Contacts lie in blocks of
// kBlock. A block holds the first number of all its contacts, then the second number, and so on. The numbers
// are doubles, or floats with mixed precision.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/system/processor.hpp"
#include "engine/laws/law_kernel.hpp"

namespace grainreel {

// Brings the numbers of contacts into a new order. Most contacts that were side by side still are in the new
// order, and are moved a block at a time.
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
    static constexpr std::int32_t kLine =
        sizeof(Line) / sizeof(double);  // numbers of the largest kind, doubles

    const std::int32_t* order_ = nullptr;
    std::int32_t count_ = 0, unchanged_ = 0;  // the first `unchanged_` stay; a multiple of kBlock
    std::vector<std::uint8_t> together_;      // whether the contacts of a block were side by side before
    LargeArray<Line> room_;
};

class Histories {
  public:
    static constexpr int kMostNumbers = 24;

    // Sets how many numbers a contact has, and their size in bytes. There are no contacts then.
    void shape(int numbers, std::size_t number_size) {
        GRAINREEL_CHECK(numbers <= kMostNumbers);
        numbers_ = numbers;
        size_ = number_size;
        lines_.clear();
    }
    int numbers() const { return numbers_; }  // numbers of a contact
    // Sets the number of contacts. New contacts hold zeros.
    void resize(std::int32_t contacts) { lines_.resize(lines_of(contacts)); }
    void reserve(std::int32_t contacts) { lines_.reserve(lines_of(contacts)); }

    double get(std::int32_t contact, int k) const {
        return size_ == sizeof(float) ? read<float>(contact, k) : read<double>(contact, k);
    }
    // Reads `count` numbers of a contact from the k-th on.
    void get(std::int32_t contact, int k, int count, double* numbers) const {
        const std::byte* at = bytes() + place(contact, k);
        for (int n = 0; n < count; ++n, at += kBlock * size_) {
            if (size_ == sizeof(float)) {
                float number;
                std::memcpy(&number, at, sizeof(float));
                numbers[n] = number;
            } else {
                std::memcpy(numbers + n, at, sizeof(double));
            }
        }
    }
    void set(std::int32_t contact, int k, double value) {
        size_ == sizeof(float) ? write(contact, k, static_cast<float>(value)) : write(contact, k, value);
    }
    void clear(std::int32_t contact) {
        for (int k = 0; k < numbers_; ++k) set(contact, k, 0);
    }
    // Puts the histories in a new order. `contacts` is the number of contacts in the old order.
    void reorder(Reorder& order, std::int32_t contacts) {
        for (int k = 0; k < numbers_; ++k) {
            const auto block = [&](std::int32_t c) { return bytes() + place(c, k); };
            size_ == sizeof(float) ? order.move<float>(contacts, block) : order.move<double>(contacts, block);
        }
    }

    // The block that starts with `contact`, as LawKernel takes it.
    void* of_block(std::int32_t contact) { return bytes() + place(contact, 0); }
    const void* of_block(std::int32_t contact) const { return bytes() + place(contact, 0); }

  private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    std::size_t lines_of(std::int32_t contacts) const {
        const std::size_t blocks = (contacts + kBlock - 1) / kBlock;
        return (blocks * kBlock * numbers_ * size_ + sizeof(Line) - 1) / sizeof(Line);
    }
    std::byte* bytes() { return reinterpret_cast<std::byte*>(lines_.data()); }
    const std::byte* bytes() const { return reinterpret_cast<const std::byte*>(lines_.data()); }
    std::size_t place(std::int32_t contact, int k) const {
        return ((contact / kBlock * static_cast<std::size_t>(numbers_) + k) * kBlock + contact % kBlock) *
               size_;
    }
    template <class Number>
    Number read(std::int32_t contact, int k) const {
        Number value;
        std::memcpy(&value, bytes() + place(contact, k), sizeof(Number));
        return value;
    }
    template <class Number>
    void write(std::int32_t contact, int k, Number value) {
        std::memcpy(bytes() + place(contact, k), &value, sizeof(Number));
    }

    int numbers_ = 0;
    std::size_t size_ = sizeof(double);
    LargeArray<Line> lines_;
};

}  // namespace grainreel
