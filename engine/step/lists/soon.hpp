// Lists the candidate pairs that may touch within a few steps. A step looks at these pairs only. Candidates
// are to last for some fifty steps, so few of them are near at any time. A list is made anew once the grains
// may have moved as far as its gap allows.
//
// The candidates are cut into several stretches, and each stretch has its own list. The lists are made in
// different steps. If all were made in the same step, one thread would wait for the other in that step.
//
// What this gains: without it a bed in flight takes 12 % more instructions, the vibrated wedge 19 %, and
// dense beds 1 % (docs/notes/performance.md, "Three devices of the step").
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "engine/base/large_array.hpp"
#include "engine/laws/touch_chunk.hpp"

namespace grainreel {

// The list of the candidates [from, to). It has room for half of them. If more are near, a list would save
// little, and the step looks at all of them.
class SoonList {
  public:
    SoonList() = default;
    // Memory for the list: `size` pairs, a whole number of blocks.
    struct Room {
        std::int32_t *first, *second, *at;
        std::int32_t size;
    };
    SoonList(std::int32_t from, std::int32_t to, const Room& room) : from_(from), to_(to), room_(room) {}
    std::int32_t from() const { return from_; }
    std::int32_t to() const { return to_; }

    // Whether the list is still complete. moved: m; no grain has moved farther since the candidates were
    // listed. False before begin().
    bool lasts(double moved) const { return moved <= lasts_until_; }
    // Begins a new list of the pairs that are closer than `gap` (m). Call add() for each pair by rising place
    // while there is room, then end().
    void begin(double moved, double gap) {
        constexpr double kKeptBack = 0.1;  // reserve for rounding and for what a corrector adds
        lasts_until_ = moved + (1 - kKeptBack) * gap / 2;
        count_ = 0;
        all_ = false;
    }
    bool has_room(int more) const { return count_ + more <= room_.size; }
    void add(std::int32_t first, std::int32_t second, std::int32_t at) {
        room_.first[count_] = first, room_.second[count_] = second, room_.at[count_++] = at;
    }
    // Fills the last block with copies of the last pair, so that whole registers can be read.
    void end() {
        for (std::int32_t k = count_; k % kBlock != 0; ++k)
            room_.first[k] = room_.first[k - 1], room_.second[k] = room_.second[k - 1];
    }
    // Gives up the list. The step looks at all candidates for as long as the list would have lasted.
    void give_up() { all_ = true; }
    bool are_all() const { return all_; }

    std::int32_t size() const { return count_; }
    // Where to read the two bodies, and the place of the pair among the candidates.
    const std::int32_t* first() const { return room_.first; }
    const std::int32_t* second() const { return room_.second; }
    std::int32_t at(std::int32_t k) const { return room_.at[k]; }

  private:
    std::int32_t from_ = 0, to_ = 0, count_ = 0;
    Room room_{nullptr, nullptr, nullptr, 0};
    bool all_ = false;
    double lasts_until_ = -std::numeric_limits<double>::infinity();  // m
};

// The lists of all stretches.
class Soon {
  public:
    // A list lasts about five steps. With five lists, about one of them is made in each step.
    static constexpr int kLists = 5;

    Soon() = default;
    Soon(Soon&&) = default;  // not copied: the lists point into the room
    Soon& operator=(Soon&&) = default;

    // Call when there are new candidates. begin() of each list must follow before the list is used.
    void expire(std::int32_t candidates) {
        const auto bound = [&](int k) {
            return k < kLists ? candidates / kChunk * k / kLists * kChunk : candidates;
        };
        const std::size_t room = (candidates / 2 + kBlock - 1) / kBlock * kBlock;
        for (auto* array : {&first_, &second_, &at_}) {
            if (array->capacity() < room) array->reserve(room + room / 8);
            array->resize(room);
        }
        for (int k = 0; k < kLists; ++k) {
            const std::int32_t from = bound(k) / 2, size = (bound(k + 1) - bound(k)) / 2;
            const std::int32_t blocks = (size + kBlock - 1) / kBlock * kBlock;
            list_[k] = {bound(k),
                        bound(k + 1),
                        {first_.data() + from, second_.data() + from, at_.data() + from, blocks}};
        }
        is_new_ = true;
    }
    // Calls work(list, gap) for each list. After expire(), the gaps are one fifth, two fifths and so on, so
    // that the lists run out one after the other.
    template <class Work>
    void each(double gap, const Work& work) {
        for (int k = 0; k < kLists; ++k) work(list_[k], is_new_ ? gap * (k + 1) / kLists : gap);
        is_new_ = false;
    }

  private:
    LargeArray<std::int32_t> first_, second_, at_;
    std::array<SoonList, kLists> list_;
    bool is_new_ = true;
};

}  // namespace grainreel
