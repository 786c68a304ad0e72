// Histories of a chunk of contacts as the kernels want them: in blocks of kBlock contacts, within a block
// number by number. The numbers are doubles, or floats with mixed precision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/laws/law_kernel.hpp"

namespace grainreel {

class Histories {
  public:
    // For kChunk contacts of so many numbers. What stays of another shape is of no use.
    void shape(int numbers, std::size_t number_size) {
        numbers_ = numbers;
        size_ = number_size;
        const std::size_t lines = (kChunk * numbers_ * size_ + sizeof(Line) - 1) / sizeof(Line);
        if (lines > lines_.size()) lines_.resize(lines);
    }
    int numbers() const { return numbers_; }  // of a contact

    double get(std::int32_t contact, int k) const {
        return size_ == sizeof(float) ? read<float>(contact, k) : read<double>(contact, k);
    }
    void set(std::int32_t contact, int k, double value) {
        size_ == sizeof(float) ? write(contact, k, static_cast<float>(value)) : write(contact, k, value);
    }

    // What LawKernel takes, for the block that starts with `contact`.
    void* of_block(std::int32_t contact) { return bytes() + place(contact, 0); }
    const void* of_block(std::int32_t contact) const { return bytes() + place(contact, 0); }

  private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    std::byte* bytes() { return reinterpret_cast<std::byte*>(lines_.data()); }
    const std::byte* bytes() const { return reinterpret_cast<const std::byte*>(lines_.data()); }
    std::size_t place(std::int32_t contact, int k) const {
        return ((contact / kBlock * numbers_ + k) * kBlock + contact % kBlock) * size_;
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
    std::vector<Line> lines_;
};

}  // namespace grainreel
