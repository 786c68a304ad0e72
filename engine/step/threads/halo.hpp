// Copies of other threads' grains, for the contacts of one thread. Once a step the owners write their grains
// into a box (memory for messages), and this thread reads the box. No thread reads the arrays that another
// thread writes. So one barrier a step is enough, and each processor keeps the cache lines of the grains that
// it integrates.
//
// Where few grains have contacts, only these go through the box. A grain without contacts flies freely, so
// this thread moves its copy by the same sums as the owner, to the same bits. This takes less time than a
// cache line that two processors share: 3 % of a step in flight, nothing in dense beds
// (docs/notes/performance.md, "Three devices of the step").
//
// The copies lie after the last grain, in reserved memory of the grains' arrays. So a contact reads a copy as
// it reads a grain.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/system/processor.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/motion/integrate.hpp"

namespace grainreel {

// Thread t owns the grains [share[t], share[t + 1]).
using Shares = std::vector<std::int32_t>;

class alignas(64) Halo {
  public:
    // The thread owns [begin, end). It reads grains whose index is at most `reach` beyond that range.
    // `grains` is the number of all grains.
    void own(std::int32_t begin, std::int32_t end, std::int32_t reach, std::int32_t grains);
    bool owns(std::int32_t grain) const { return grain >= begin_ && grain < end_; }
    // These functions say which grains of other threads the thread reads until the next begin_list(). Call
    // begin_list(), then need() in any order; a grain may be named more than once.
    void begin_list();
    void need(std::int32_t grain) {
        if (owns(grain)) return;
        std::int32_t& slot = slot_[grain - lowest_];
        if (slot == kNone) foreign_.push_back(grain), slot = kNeeded;
    }
    // The same for the bodies of `count` pairs.
    void need(const std::int32_t* first, const std::int32_t* second, std::int32_t count);
    std::int32_t size() const { return static_cast<std::int32_t>(foreign_.size()); }
    // Makes room for as many copies as are needed now. The first copy gets the index `at`. `owners` is the
    // number of threads.
    void make_room(std::int32_t at, int owners);
    // Ends the list. The grains' arrays must have room for the copies.
    void end_list(Grains& grains, const Shares& shares);
    // Sets all copies from the grains themselves. Call it only while no thread moves any grain.
    void copy(Grains& grains) const;

    // Called by the owner: writes its grains into one of the two boxes. If few of them are `loaded`, only
    // these are written, and the same must hold until the next copy(). With nullptr all are written. A caller
    // that takes the two boxes in turn needs one barrier only, between put() and get().
    void put(const Grains& grains, const Loaded* loaded, int owner, int box);
    // Called by the thread itself: sets its copies from the box. Copies whose grains are not in the box are
    // moved by `flight`, in the same way as the owner has moved the grains.
    void get(Grains& grains, int box, const FreeFlight& flight);

    // Where to read the bodies of `count` pairs (at most kChunk) and of the copies that fill their last
    // block. For grains of other threads this is the place of the copy. Valid until the next call.
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
    // One owner's part: the copies [begin, end) of foreign_, and the first line of the part in a box. The
    // part begins with one bit for each copy, which says whether its grain is in the box. The numbers of
    // these grains follow.
    struct Part {
        std::int32_t begin, end, line;
    };
    bool all_own(const std::int32_t* first, const std::int32_t* second, int count) const;
    Bodies find_foreign(const std::int32_t* first, const std::int32_t* second, int count);

    static constexpr std::int32_t kNone = -1,
                                  kNeeded =
                                      -2;  // slots without a copy, and slots whose copy is still to be placed
    std::int32_t begin_ = 0, end_ = 0, at_ = 0;
    std::int32_t lowest_ = 0;            // the first grain that may be read
    std::vector<std::int32_t> foreign_;  // indices of the copied grains, rising
    std::vector<std::int32_t> slot_;     // where to read each grain from lowest_ on, own grains included
    std::vector<Part> part_;             // one for each thread
    std::array<LargeArray<Line>, 2> box_;
    alignas(64) std::int32_t first_[kChunk] = {}, second_[kChunk] = {};
};

// The answers of find() for a whole list of pairs. They are computed once and hold as long as the list.
class FoundPairs {
  public:
    void set(Halo& halo, const std::int32_t* first, const std::int32_t* second, std::int32_t count);
    // The bodies of the chunk that begins at pair c. c is a multiple of kChunk.
    Halo::Bodies of(const std::int32_t* first, const std::int32_t* second, std::int32_t c) const {
        const std::int32_t at = at_.empty() ? kAsListed : at_[c / kChunk];
        if (at == kAsListed) return {first + c, second + c};
        return {first_.data() + at, second_.data() + at};
    }

  private:
    static constexpr std::int32_t kAsListed = -1;
    std::vector<std::int32_t> at_;              // where each chunk begins in the next two arrays
    std::vector<std::int32_t> first_, second_;  // bodies of the chunks that hold grains of other threads
};

// Makes room for `count` copies after the grains.
void reserve_copies(Grains& grains, std::int32_t count);

}  // namespace grainreel
