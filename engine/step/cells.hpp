// Zones of the original program: the hopper's space in boxes, at least as wide as the search radius, so that
// the neighbours of a grain are in its own box or in the 26 around it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"

namespace grainreel {

class Cells {
  public:
    // Boxes over the grains as they lie, of edge >= width (m). `period` (m): of x, centred on 0; 0 for none.
    // A grain beyond a quarter billion boxes is not to be expected of a healthy run: boxes grow instead.
    void lay(const std::vector<Place>& place, double width, double period);

    // order[new] = old: grains sorted by box, x fastest; within a box in their old order.
    const std::vector<std::int32_t>& order() const { return order_; }

    // After the grains were put in that order: [first, last) of the boxes x-1 .. x+1 in row (y, z).
    // Rows lie one behind the other, so a grain's possible partners with a higher index are in its own row
    // and in the four rows after it, besides what a period adds.
    struct Range {
        std::int32_t first, last;
    };
    // Ranges that may hold partners of grain i with an index above i; at most 14.
    int partners_after(const Vec3& position, std::int32_t i, std::array<Range, 14>& ranges) const;

  private:
    std::array<int, 3> box_of(const Vec3& position) const;
    std::int64_t index(int x, int y, int z) const {
        return (static_cast<std::int64_t>(z) * count_[1] + y) * count_[0] + x;
    }

    Vec3 origin_{0, 0, 0};
    Vec3 inverse_width_{0, 0, 0};
    std::array<int, 3> count_{1, 1, 1};
    bool periodic_ = false;
    std::vector<std::int32_t> start_;  // first grain of each box, and one past the last
    std::vector<std::int32_t> order_;
    std::vector<std::int32_t> box_;  // of each grain, before sorting
};

}  // namespace grainreel
