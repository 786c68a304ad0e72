// What a thread's contacts read of other threads' grains: copies, brought once a step through a box that the
// owners write to and this thread reads. So nobody reads what another thread writes, one barrier a step is
// enough, and a processor keeps the lines of the grains that it integrates.
//
// Where few grains have contacts, only those come through the box: the copies of the others fly here as the
// grains do there, by the same sums, which takes less time than a line that two processors share.
//
// Copies stand where contacts can reach them like grains: behind the last grain, in room that the grains'
// arrays have beyond their size.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/large_array.hpp"
#include "engine/laws/touch_chunk.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/forces/integrate.hpp"

namespace grainreel {

// Thread t owns the grains [share[t], share[t + 1]).
using Shares = std::vector<std::int32_t>;

class alignas(64) Halo {
  public:
    // The thread owns [begin, end) and reads grains at most `reach` beyond, of `grains` in all.
    void own(std::int32_t begin, std::int32_t end, std::int32_t reach, std::int32_t grains);
    bool owns(std::int32_t grain) const { return grain >= begin_ && grain < end_; }
    // Which of them it reads until the next call: begin_list(), then need() in any order, as often as one
    // likes.
    void begin_list();
    void need(std::int32_t grain) {
        if (owns(grain)) return;
        std::int32_t& slot = slot_[grain - lowest_];
        if (slot == kNone) foreign_.push_back(grain), slot = kNeeded;
    }
    // Bodies of so many pairs.
    void need(const std::int32_t* first, const std::int32_t* second, std::int32_t count);
    std::int32_t size() const { return static_cast<std::int32_t>(foreign_.size()); }
    // Makes room for as many of so many threads as are needed now, the copies' indices being those from `at`
    // on.
    void make_room(std::int32_t at, int owners);
    // Ends a list. The grains' arrays have room for the copies.
    void end_list(Grains& grains, const Shares& shares);
    // Sets all copies from the grains where they are: while no thread moves any.
    void copy(Grains& grains) const;

    // By the owner: its grains as they are now, into one of two boxes; if few are `loaded`, only those
    // (nullptr: all), which is what they remain until the next copy(). Who takes the boxes in turn needs no
    // barrier but that between put() and get().
    void put(const Grains& grains, const Loaded* loaded, int owner, int box);
    // By the thread itself: to the copies. Those that have not come move from where they are, as their owner
    // has moved all of his.
    void get(Grains& grains, int box, const Flight& flight);

    // Where the bodies of `count` pairs, at most kChunk, and of what fills their last block, stand: foreign
    // ones among the copies. Valid until the next call.
    struct Bodies {
        const std::int32_t *first, *second;
    };
    Bodies find(const std::int32_t* first, const std::int32_t* second, int count) {
        if (foreign_.empty() || all_own(first, second, count)) return {first, second};
        return find_foreign(first, second, count);
    }

    bool has_foreign() const { return !foreign_.empty(); }

  private:
    struct alignas(64) Line {
        double number[8];
    };
    // The copies [begin, end) of foreign_, of one owner, and its lines in a box: a bit a copy, whether it
    // comes, then the numbers of those that do.
    struct Part {
        std::int32_t begin, end, line;
    };
    bool all_own(const std::int32_t* first, const std::int32_t* second, int count) const;
    Bodies find_foreign(const std::int32_t* first, const std::int32_t* second, int count);

    static constexpr std::int32_t kNone = -1, kNeeded = -2;  // slots without a copy, or not yet
    std::int32_t begin_ = 0, end_ = 0, at_ = 0;
    std::int32_t lowest_ = 0;            // grain that may be read
    std::vector<std::int32_t> foreign_;  // rising
    std::vector<std::int32_t> slot_;     // of the grains from lowest_ on, own ones too: where to read them
    std::vector<Part> part_;             // of each thread
    std::array<LargeArray<Line>, 2> box_;
    alignas(64) std::int32_t first_[kChunk] = {}, second_[kChunk] = {};
};

// A list of pairs as find() has it, worked out once for as long as the list stays.
class FoundPairs {
  public:
    void set(Halo& halo, const std::int32_t* first, const std::int32_t* second, std::int32_t count);
    // The chunk of the list from c on, a multiple of kChunk.
    Halo::Bodies of(const std::int32_t* first, const std::int32_t* second, std::int32_t c) const {
        const std::int32_t at = at_.empty() ? kAsListed : at_[c / kChunk];
        if (at == kAsListed) return {first + c, second + c};
        return {first_.data() + at, second_.data() + at};
    }

  private:
    static constexpr std::int32_t kAsListed = -1;
    std::vector<std::int32_t> at_;              // of each chunk: where it stands in the following
    std::vector<std::int32_t> first_, second_;  // of the chunks that have foreign bodies
};

// Room for so many copies.
void reserve_copies(Grains& grains, std::int32_t count);

}  // namespace grainreel
