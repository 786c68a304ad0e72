// The histories of contacts, in the layout that the kernels of the laws read. Contacts stand in blocks of
// kBlock. A block holds the first number of all its contacts, then the second number, and so on. The numbers
// are doubles, or floats with mixed precision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/base/large_array.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/step/grid/reorder.hpp"

namespace grainreel {

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
    int numbers() const { return numbers_; }  // of a contact
    // Sets the number of contacts. New contacts hold zeros.
    void resize(std::int32_t contacts) { lines_.resize(lines_of(contacts)); }
    void reserve(std::int32_t contacts) { lines_.reserve(lines_of(contacts)); }

    double get(std::int32_t contact, int k) const {
        return size_ == sizeof(float) ? read<float>(contact, k) : read<double>(contact, k);
    }
    // `count` numbers of a contact from the k-th on.
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
    // Puts the histories in a new order. `contacts` is their number before.
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
