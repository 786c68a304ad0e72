// Marks those of a thread's grains that have contacts. Only these can get a load before the lists are made
// again. The load of any other grain is zero and stays zero, so it is neither read nor cleared. Another
// thread can compute the flight of such a grain as well as its owner can.
#pragma once

#include <cstdint>
#include <vector>

namespace grainreel {

// One bit for each grain, so that the bits of a million grains fit into the cache.
class Loaded {
  public:
    // The thread owns [begin, end), and none of these grains is marked.
    void clear(std::int32_t begin, std::int32_t end) {
        begin_ = begin, end_ = end, count_ = 0;
        words_.assign((end - begin) / 64 + 2, 0);
    }
    // Marks a grain. Grains of other threads are ignored.
    void note(std::int32_t grain) {
        if (grain < begin_ || grain >= end_) return;
        const auto at = static_cast<std::uint32_t>(grain - begin_);
        const std::uint64_t bit = std::uint64_t{1} << at % 64;
        count_ += (words_[at / 64] & bit) == 0;
        words_[at / 64] |= bit;
    }
    bool has(std::int32_t grain) const { return from(grain) & 1; }
    // Whether so few grains are marked that it pays to treat the others apart: a quarter or less.
    bool few() const { return count_ <= (end_ - begin_) / 4; }
    // The bits of 64 grains from `grain` on. It must be one of the thread's own grains.
    std::uint64_t from(std::int32_t grain) const {
        const auto at = static_cast<std::uint32_t>(grain - begin_);
        return words_[at / 64] >> at % 64 | words_[at / 64 + 1] << 1 << (63 - at % 64);
    }

  private:
    std::int32_t begin_ = 0, end_ = 0, count_ = 0;
    std::vector<std::uint64_t> words_;
};

}  // namespace grainreel
