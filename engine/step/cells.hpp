// Zones of the original program: space in boxes, so that only grains in boxes close by are looked at. One
// grid for each octave of radii, in boxes as wide as its grains: a large grain among small ones costs what it
// covers, and the small ones as much as if it were not there.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"

namespace grainreel {

// A grid over some of the grains.
class Grid {
  public:
    // Boxes over the members (indices of grains, rising) of edge >= width (m), at most a few for each of
    // them: those of an empty tall container grow. `period` (m): of x, centred on 0; 0 for none.
    void lay(const std::vector<Place>& place, const std::vector<std::int32_t>& members, double width,
             double period);

    // The members by box, x fastest; within a box by rising index.
    const std::vector<std::int32_t>& in_order() const { return in_order_; }

    // Calls each(first, last) for ranges that hold the members of all boxes within `reach` (m) of a place,
    // in each direction. What is returned holds no member twice.
    template <class Each>
    void near(const Vec3& centre, double reach, const Each& each) const {
        const std::array<int, 2> x = boxes(centre, reach, 0), y = boxes(centre, reach, 1),
                                 z = boxes(centre, reach, 2);
        const int last = count_[0] - 1;
        for (int row_z = std::max(z[0], 0); row_z <= std::min(z[1], count_[2] - 1); ++row_z) {
            for (int row_y = std::max(y[0], 0); row_y <= std::min(y[1], count_[1] - 1); ++row_y) {
                const auto row = [&](int from, int to) {
                    if (from > to) return;
                    const std::int32_t first = start_[index(from, row_y, row_z)];
                    const std::int32_t end = start_[index(to, row_y, row_z) + 1];
                    if (first < end) each(in_order_.data() + first, in_order_.data() + end);
                };
                if (periodic_ && x[1] - x[0] >= last) {
                    row(0, last);
                    continue;
                }
                row(std::max(x[0], 0), std::min(x[1], last));
                if (!periodic_) continue;
                row(x[0] + count_[0], last);
                row(0, x[1] - count_[0]);
            }
        }
    }

  private:
    // First and last box within `reach`; perhaps outside the grid, by at most one turn of a period.
    std::array<int, 2> boxes(const Vec3& centre, double reach, int axis) const {
        const double at = centre[axis] - origin_[axis], scale = inverse_width_[axis];
        return {box(at - reach, scale, axis), box(at + reach, scale, axis)};
    }
    int box(double at, double scale, int axis) const {
        const double count = count_[axis];
        return static_cast<int>(std::clamp(at * scale + count, 0.0, 3 * count)) - count_[axis];
    }
    std::int32_t box_of(const Vec3& position) const;
    std::int64_t index(int x, int y, int z) const {
        return (static_cast<std::int64_t>(z) * count_[1] + y) * count_[0] + x;
    }

    Vec3 origin_{0, 0, 0};
    Vec3 inverse_width_{0, 0, 0};
    std::array<int, 3> count_{1, 1, 1};
    bool periodic_ = false;
    std::vector<std::int32_t> start_;  // first member of each box, and one past the last
    std::vector<std::int32_t> in_order_;
    std::vector<std::int32_t> box_, next_;  // while sorting
};

class Cells {
  public:
    // order[new] = old: grains sorted by the boxes of the most frequent size. m: skin, period as for Grid.
    const std::vector<std::int32_t>& order(const std::vector<Place>& place, double skin, double period);

    // The grids, for grains in that order.
    void lay(const std::vector<Place>& place, double skin, double period);

    struct Level {
        std::vector<std::int32_t> members;
        double largest = 0;  // m, radius
        Grid grid;
        bool rising = false;  // its grains stand in the grid's own order, their indices rising
    };
    const std::vector<Level>& levels() const { return levels_; }

  private:
    void sort_into_levels(const std::vector<Place>& place);

    std::vector<Level> levels_;  // those that have members
    std::vector<std::int32_t> everybody_;
    Grid whole_;
};

}  // namespace grainreel
