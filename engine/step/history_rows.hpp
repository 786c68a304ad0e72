// Where the histories of touching contacts live: a row each, taken when a contact begins and given back when
// it ends, so that nothing moves while grains only come near and part. A chunk's rows are brought together
// for a law and put back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/step/histories.hpp"

namespace grainreel {

class HistoryRows {
  public:
    static constexpr int kMostNumbers = 24;
    static constexpr std::int32_t kNone = 0;     // a row of zeros, for contacts without a history
    static constexpr std::int32_t kScratch = 1;  // one that nobody reads, for the fill of a chunk

    // Rows of so many numbers, at most kMostNumbers; all are free.
    void shape(int numbers, std::size_t number_size) {
        numbers_ = numbers;
        size_ = number_size;
        GRAINREEL_CHECK(numbers <= kMostNumbers);
        stride_ = (numbers + 3) / 4 * 4;
        free_.clear();
        used_ = 2;
        lines_.assign((2 * stride_ * size_ + sizeof(Line) - 1) / sizeof(Line), Line{});
    }
    int numbers() const { return numbers_; }

    // A row of zeros.
    std::int32_t take() {
        if (!free_.empty()) {
            const std::int32_t row = free_.back();
            free_.pop_back();
            return row;
        }
        const std::size_t lines = ((used_ + 1) * stride_ * size_ + sizeof(Line) - 1) / sizeof(Line);
        if (lines > lines_.size()) lines_.resize(lines);
        return static_cast<std::int32_t>(used_++);
    }
    void give_back(std::int32_t row) {
        std::memset(at(row), 0, stride_ * size_);
        free_.push_back(row);
    }

    double get(std::int32_t row, int k) const {
        return size_ == sizeof(float) ? number<float>(row, k) : number<double>(row, k);
    }
    void set(std::int32_t row, int k, double value) {
        if (size_ == sizeof(float)) {
            const float rounded = static_cast<float>(value);
            std::memcpy(at(row) + k * size_, &rounded, sizeof rounded);
        } else {
            std::memcpy(at(row) + k * size_, &value, sizeof value);
        }
    }

    // Rows row[0] .. row[count - 1], count a multiple of kBlock, to and from a chunk of at least as many
    // numbers a contact as a row has with its fill (chunk_numbers()).
    void bring(const std::int32_t* row, int count, Histories& chunk) const;
    void put_back(const std::int32_t* row, int count, const Histories& chunk);
    int chunk_numbers() const { return static_cast<int>(stride_); }

    std::size_t bytes() const {
        return lines_.capacity() * sizeof(Line) + free_.capacity() * sizeof(free_[0]);
    }

  private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    std::byte* at(std::int32_t row) {
        return reinterpret_cast<std::byte*>(lines_.data()) + row * stride_ * size_;
    }
    const std::byte* at(std::int32_t row) const {
        return reinterpret_cast<const std::byte*>(lines_.data()) + row * stride_ * size_;
    }
    template <class Number>
    double number(std::int32_t row, int k) const {
        Number value;
        std::memcpy(&value, at(row) + k * size_, sizeof value);
        return value;
    }

    int numbers_ = 0;
    std::size_t stride_ = 0, size_ = sizeof(double);
    std::size_t used_ = 2;
    std::vector<Line> lines_;
    std::vector<std::int32_t> free_;
};

}  // namespace grainreel
