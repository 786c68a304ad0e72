// Histories of contacts as the laws' kernels want them: in blocks of kBlock contacts, within a block number
// by number. The numbers are doubles, or floats with mixed precision.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/base/large_array.hpp"
#include "engine/laws/law_kernel.hpp"

namespace grainreel {

class Histories {
  public:
    static constexpr int kMostNumbers = 24;

    // So many numbers a contact; no contact yet.
    void shape(int numbers, std::size_t number_size) {
        GRAINREEL_CHECK(numbers <= kMostNumbers);
        numbers_ = numbers;
        size_ = number_size;
        lines_.clear();
    }
    int numbers() const { return numbers_; }  // of a contact
    // Room for so many contacts; new ones hold zeros.
    void resize(std::int32_t contacts) { lines_.resize(lines_of(contacts)); }
    void reserve(std::int32_t contacts) { lines_.reserve(lines_of(contacts)); }

    double get(std::int32_t contact, int k) const {
        return size_ == sizeof(float) ? read<float>(contact, k) : read<double>(contact, k);
    }
    void set(std::int32_t contact, int k, double value) {
        size_ == sizeof(float) ? write(contact, k, static_cast<float>(value)) : write(contact, k, value);
    }
    void clear(std::int32_t contact) {
        for (int k = 0; k < numbers_; ++k) set(contact, k, 0);
    }
    // Puts contact order[c] at c, for all c < count; in `room` there is a double for each.
    void permute(const std::int32_t* order, std::int32_t count, double* room) {
        for (int k = 0; k < numbers_; ++k)
            size_ == sizeof(float) ? permute_number<float>(order, count, k, room)
                                   : permute_number<double>(order, count, k, room);
    }

    // What LawKernel takes, for the block that starts with `contact`.
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
    template <class Number>
    void permute_number(const std::int32_t* order, std::int32_t count, int k, void* room) {
        auto* moved = static_cast<std::byte*>(room);
        const auto copy = [](std::byte* to, const std::byte* from, std::int32_t many) {
            std::memcpy(to, from, many * sizeof(Number));
        };
        constexpr std::int32_t ahead = 128;  // contacts: lines of one number lie too far apart to be foreseen
        for (std::int32_t c = 0; c < count; ++c) {
            __builtin_prefetch(bytes() + place(order[std::min(c + ahead, count - 1)], k));
            copy(moved + c * sizeof(Number), bytes() + place(order[c], k), 1);
        }
        for (std::int32_t c = 0; c < count; c += kBlock)
            copy(bytes() + place(c, k), moved + c * sizeof(Number), std::min(kBlock, count - c));
    }

    int numbers_ = 0;
    std::size_t size_ = sizeof(double);
    LargeArray<Line> lines_;
};

}  // namespace grainreel
