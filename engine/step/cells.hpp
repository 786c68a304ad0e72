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
    // them: those of an empty tall container grow. `axes`: along which boxes follow each other, fastest
    // first. `period` (m): of x, centred on 0, which is then the fastest; 0 for none.
    void lay(const LargeArray<Place>& place, const std::vector<std::int32_t>& members, double width,
             const std::array<int, 3>& axes, double period);

    // The members by box; within a box by rising index.
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
                const std::int64_t begin = index(0, row_y, row_z);
                const auto row = [&](int from, int to) {
                    if (from > to) return;
                    const std::int32_t first = start_[begin + from], end = start_[begin + to + 1];
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
    // First and last box within `reach` along the a-th axis; perhaps outside the grid, by at most one turn of
    // a period.
    std::array<int, 2> boxes(const Vec3& centre, double reach, int a) const {
        const double at = centre[axes_[a]] - origin_[a];
        return {box(at - reach, a), box(at + reach, a)};
    }
    // Of a bed that blows up, what is no number any more goes to the first: the health check will say so.
    int box(double at, int a) const {
        const double count = count_[a];
        return static_cast<int>(std::max(0.0, std::min(at * inverse_width_[a] + count, 3 * count))) -
               count_[a];
    }
    std::int32_t box_of(const Vec3& position) const;
    // Rows of boxes along the fastest axis follow each other tile by tile, so that the rows around one are
    // still in the processor's cache when they are wanted again. All the grid is one tile while it is small:
    // then threads share it in slices, and few grains have partners of another thread.
    static constexpr int kTileBits = 3, kOneTileBits = 30;
    std::int64_t index(int x, int y, int z) const {
        const int tile_y = y >> tile_bits_ << tile_bits_, tile_z = z >> tile_bits_ << tile_bits_;
        const int wide = std::min(1 << tile_bits_, count_[1] - tile_y),
                  high = std::min(1 << tile_bits_, count_[2] - tile_z);
        const std::int64_t row = static_cast<std::int64_t>(tile_z) * count_[1] + tile_y * high +
                                 (z - tile_z) * wide + (y - tile_y);
        return row * count_[0] + x;
    }

    std::array<int, 3> axes_{0, 1, 2};
    Vec3 origin_{0, 0, 0}, inverse_width_{0, 0, 0};  // along these
    std::array<int, 3> count_{1, 1, 1};              // likewise
    int tile_bits_ = kTileBits;                      // 2 to the power of these: rows to a tile's side
    bool periodic_ = false;
    std::vector<std::int32_t> start_;  // first member of each box, and one past the last
    std::vector<std::int32_t> in_order_;
    std::vector<std::int32_t> box_;  // of each member, while sorting
};

class Cells {
  public:
    // order[new] = old: grains sorted by the boxes of the most frequent size, slowest along the bed's longest
    // side, so that what touches lies close in memory and few contacts cross from thread to thread. m: skin,
    // period as for Grid. Stays until lay().
    const std::vector<std::int32_t>& order(const LargeArray<Place>& place, double skin, double period);

    // The grids, for grains in that order.
    void lay(const LargeArray<Place>& place, double skin, double period);

    struct Level {
        std::vector<std::int32_t> members;
        double largest = 0;  // m, radius
        Grid grid;
        bool rising = false;  // its grains stand in the grid's own order, their indices rising
    };
    const std::vector<Level>& levels() const { return levels_; }

  private:
    void sort_into_levels(const LargeArray<Place>& place);

    std::vector<Level> levels_;  // those that have members
    std::array<int, 3> axes_{0, 1, 2};
};

}  // namespace grainreel
