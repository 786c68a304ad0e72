// The marked pixels of a row.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace grainreel {

class RowBits {
  public:
    // Room for a row of `width` pixels, all to be written before they are read.
    std::uint64_t* room(int width) {
        width_ = width;
        words_.resize(static_cast<std::size_t>(width) / 64 + 1);
        words_.back() = 0;
        return words_.data();
    }
    bool at(int x) const { return words_[static_cast<std::size_t>(x) / 64] >> (x % 64) & 1; }
    // The first marked pixel from x on, or the width.
    int next(int x) const {
        if (x >= width_) return width_;
        std::size_t word = static_cast<std::size_t>(x) / 64;
        std::uint64_t left = words_[word] & (~std::uint64_t{0} << (x % 64));
        while (left == 0 && ++word < words_.size()) left = words_[word];
        return left ? static_cast<int>(word * 64) + std::countr_zero(left) : width_;
    }

  private:
    int width_ = 0;
    std::vector<std::uint64_t> words_;
};

}  // namespace grainreel
