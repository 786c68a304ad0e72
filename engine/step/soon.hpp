// Of the candidates of a table of pairs, those that may touch within a few steps. The others are not looked
// at before grains have moved as far as that takes: of candidates that are to last for some fifty steps, few
// are near at any time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>

#include "engine/base/large_array.hpp"
#include "engine/laws/touch_chunk.hpp"

namespace grainreel {

class Soon {
  public:
    // There are other candidates, so many: begin() is to come before anything is asked. There is room for
    // half of them: where more are near, little would be saved.
    void expire(std::int32_t candidates) {
        const std::size_t room = (candidates / 2 + kBlock - 1) / kBlock * kBlock;
        for (auto* array : {&first_, &second_, &at_}) {
            if (array->capacity() < room) array->reserve(room + room / 8);
            array->resize(room);
        }
        lasts_until_ = -std::numeric_limits<double>::infinity();
    }
    // moved: m, that no grain has surpassed since the candidates were listed.
    bool lasts(double moved) const { return moved <= lasts_until_; }
    // A new list, of pairs closer to each other than `gap` (m): add() them by rising place as long as there
    // is room, then end().
    void begin(double moved, double gap) {
        constexpr double kKeptBack = 0.1;  // for what is not counted: rounding, what a corrector adds
        lasts_until_ = moved + (1 - kKeptBack) * gap / 2;
        count_ = 0;
        all_ = false;
    }
    bool has_room(int more) const { return count_ + more <= std::ssize(at_); }
    void add(std::int32_t first, std::int32_t second, std::int32_t at) {
        first_[count_] = first, second_[count_] = second, at_[count_++] = at;
    }
    // What fills the last block repeats the last pair, so that whole registers can be read.
    void end() {
        for (std::int32_t k = count_; k % kBlock != 0; ++k)
            first_[k] = first_[k - 1], second_[k] = second_[k - 1];
    }
    // In place of a list: all candidates are to be looked at, for as long as it would have lasted.
    void give_up() { all_ = true; }
    bool are_all() const { return all_; }

    std::int32_t size() const { return count_; }
    // Where to read the bodies, and the pair's place among the candidates.
    const std::int32_t* first() const { return first_.data(); }
    const std::int32_t* second() const { return second_.data(); }
    std::int32_t at(std::int32_t k) const { return at_[k]; }

  private:
    LargeArray<std::int32_t> first_, second_, at_;
    std::int32_t count_ = 0;
    bool all_ = false;
    double lasts_until_ = -std::numeric_limits<double>::infinity();  // m
};

}  // namespace grainreel
