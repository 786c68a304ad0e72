// Which of a thread's grains contacts may push before its lists are made again. The loads of the others are
// zero and stay so: they need neither be read nor cleared, and where they fly to, another thread can tell as
// well as their owner.
#pragma once

#include <cstdint>
#include <vector>

namespace grainreel {

// A bit a grain: a bed of a million has room for them in the cache.
class Loaded {
  public:
    // None of the grains [begin, end).
    void clear(std::int32_t begin, std::int32_t end) {
        begin_ = begin, end_ = end, count_ = 0;
        words_.assign((end - begin) / 64 + 2, 0);
    }
    // Of other grains nothing is noted.
    void note(std::int32_t grain) {
        if (grain < begin_ || grain >= end_) return;
        const auto at = static_cast<std::uint32_t>(grain - begin_);
        const std::uint64_t bit = std::uint64_t{1} << at % 64;
        count_ += (words_[at / 64] & bit) == 0;
        words_[at / 64] |= bit;
    }
    bool has(std::int32_t grain) const { return from(grain) & 1; }
    // So few that it pays to look for the others: a quarter of the grains, or less.
    bool few() const { return count_ <= (end_ - begin_) / 4; }
    // A bit a grain from this one on, which is one of the thread's.
    std::uint64_t from(std::int32_t grain) const {
        const auto at = static_cast<std::uint32_t>(grain - begin_);
        return words_[at / 64] >> at % 64 | words_[at / 64 + 1] << 1 << (63 - at % 64);
    }

  private:
    std::int32_t begin_ = 0, end_ = 0, count_ = 0;
    std::vector<std::uint64_t> words_;
};

}  // namespace grainreel
