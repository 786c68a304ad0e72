// Picks from many pairs those that are close to each other.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/laws/touch_chunk.hpp"
#include "engine/step/geometry/contact_geometry.hpp"

namespace grainreel {

// Collects pairs into chunks, and passes on those that are closer than `gap` (m).
template <class Pass>
class NearPairs {
  public:
    NearPairs(const Grains& grains, double period, double gap, const Pass& pass)
        : grains_(grains), period_(period), gap_(gap), pass_(pass) {}
    void add(std::int32_t i, std::int32_t j) {
        first_[count_] = i, second_[count_] = j;
        if (++count_ == kChunk) pass_chunk();
    }
    // Adds all partners of a grain. They are copied eight at a time, so that the processor need not predict
    // how many there are. Memory behind the partners can be read up to `end`.
    void add(std::int32_t i, const std::int32_t* partner, std::int32_t partners, const std::int32_t* end) {
        if (end - partner < partners + kMore) {
            for (std::int32_t k = 0; k < partners; ++k) add(i, partner[k]);
            return;
        }
        for (std::int32_t k = 0; k < partners; k += kMore) {
            std::fill_n(first_ + count_, kMore, i);
            std::copy_n(partner + k, kMore, second_ + count_);
            count_ += std::min(kMore, partners - k);
            if (count_ >= kChunk) pass_chunk();
        }
    }
    void flush() {
        // Copies of the last pair fill the last block. This thread may read them.
        for (int k = count_; k > 0 && k % kBlock != 0; ++k)
            first_[k] = first_[k - 1], second_[k] = second_[k - 1];
        pass_near(count_);
        count_ = 0;
    }

  private:
    static constexpr int kMore = 8;

    void pass_chunk() {
        pass_near(kChunk);
        std::copy_n(first_ + kChunk, kMore, first_);
        std::copy_n(second_ + kChunk, kMore, second_);
        count_ -= kChunk;
    }
    void pass_near(int count) {
        std::uint64_t left = near_pairs(grains_, first_, second_, count, period_, gap_);
        left &= bits_of_first(count);
        for (; left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            pass_(first_[k], second_[k]);
        }
    }

    const Grains& grains_;
    const double period_, gap_;
    const Pass& pass_;
    std::int32_t first_[kChunk + kMore] = {}, second_[kChunk + kMore] = {};
    int count_ = 0;
};

}  // namespace grainreel
