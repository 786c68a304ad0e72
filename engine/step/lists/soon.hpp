// Of the candidates of a table of pairs, those that may touch within a few steps. The others are not looked
// at before grains have moved as far as that takes: of candidates that are to last for some fifty steps, few
// are near at any time.
//
// There are several lists, of stretches of the candidates, that take turns in being made: were all made in
// one step, one thread would wait for the other in that step, and be waited for in the steps between.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "engine/base/large_array.hpp"
#include "engine/laws/touch_chunk.hpp"

namespace grainreel {

// Of the candidates [from, to). There is room for half of them: where more are near, little would be saved.
class SoonList {
  public:
    SoonList() = default;
    // room: where so many are noted, a whole number of blocks.
    struct Room {
        std::int32_t *first, *second, *at;
        std::int32_t size;
    };
    SoonList(std::int32_t from, std::int32_t to, const Room& room) : from_(from), to_(to), room_(room) {}
    std::int32_t from() const { return from_; }
    std::int32_t to() const { return to_; }

    // moved: m, that no grain has surpassed since the candidates were listed. False before begin().
    bool lasts(double moved) const { return moved <= lasts_until_; }
    // A new list, of pairs closer to each other than `gap` (m): add() them by rising place as long as there
    // is room, then end().
    void begin(double moved, double gap) {
        constexpr double kKeptBack = 0.1;  // for what is not counted: rounding, what a corrector adds
        lasts_until_ = moved + (1 - kKeptBack) * gap / 2;
        count_ = 0;
        all_ = false;
    }
    bool has_room(int more) const { return count_ + more <= room_.size; }
    void add(std::int32_t first, std::int32_t second, std::int32_t at) {
        room_.first[count_] = first, room_.second[count_] = second, room_.at[count_++] = at;
    }
    // What fills the last block repeats the last pair, so that whole registers can be read.
    void end() {
        for (std::int32_t k = count_; k % kBlock != 0; ++k)
            room_.first[k] = room_.first[k - 1], room_.second[k] = room_.second[k - 1];
    }
    // In place of a list: all candidates are to be looked at, for as long as it would have lasted.
    void give_up() { all_ = true; }
    bool are_all() const { return all_; }

    std::int32_t size() const { return count_; }
    // Where to read the bodies, and the pair's place among the candidates.
    const std::int32_t* first() const { return room_.first; }
    const std::int32_t* second() const { return room_.second; }
    std::int32_t at(std::int32_t k) const { return room_.at[k]; }

  private:
    std::int32_t from_ = 0, to_ = 0, count_ = 0;
    Room room_{nullptr, nullptr, nullptr, 0};
    bool all_ = false;
    double lasts_until_ = -std::numeric_limits<double>::infinity();  // m
};

// Stretch after stretch.
class Soon {
  public:
    // As many as there are steps between two turns of a list.
    static constexpr int kLists = 5;

    Soon() = default;
    Soon(Soon&&) = default;  // not copied: the lists point into the room
    Soon& operator=(Soon&&) = default;

    // There are other candidates, so many: begin() of each list is to come before it is asked anything.
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
    // work(list, gap): the first lists are for gaps of a fifth, two fifths and so on, so that their turns
    // come one by one.
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
