// Sets of numbers that are joined step by step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace grainreel {

class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    // The lowest number of the set.
    std::int32_t root(std::int32_t i) {
        while (parent(i) != i) {
            parent(i) = parent(parent(i));
            i = parent(i);
        }
        return i;
    }
    // Whether they were apart.
    bool join(std::int32_t a, std::int32_t b) {
        a = root(a);
        b = root(b);
        parent(std::max(a, b)) = std::min(a, b);
        return a != b;
    }

  private:
    std::int32_t& parent(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }
    std::vector<std::int32_t> parent_;
};

}  // namespace grainreel
