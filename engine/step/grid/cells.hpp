// Space is divided into boxes, so that a search for neighbours looks only at boxes close by. (They are the
// zones of the original program; see docs/notes/step.md.) Each octave of radii (a factor of two) has a grid
// of its own, with boxes as wide as its grains. So a large grain among small ones costs as much as the space
// that it covers, and the small ones cost no more because of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"

namespace grainreel {

// What the grids over a bed have in common. `axes` is the order in which boxes follow each other, the fastest
// axis first. `period` (m) is the period of x, centred on 0, with x as the fastest axis; 0 for none.
struct GridLayout {
    Vec3 low{0, 0, 0}, high{0, 0, 0};  // m, around all grains
    std::size_t grains = 0;
    std::array<int, 3> axes{0, 1, 2};
    double period = 0;
};

// A grid over some of the grains.
class Grid {
  public:
    // Sorts the members (indices of grains, rising) into boxes whose edge is at least `width` (m). There are
    // at most a few boxes for each grain: in a tall container that is mostly empty they are wider. Grids of
    // one frame and one width have the same boxes.
    void lay(const LargeArray<Place>& place, const std::vector<std::int32_t>& members, double width,
             const GridLayout& frame);
    // Call it when all members have been put in the grid's order. Only `members` stay, given by their rising
    // new indices.
    void keep(const std::vector<std::int32_t>& members);
    // Makes near() return at once for places far from all members. This pays where members are few.
    void mark_surroundings(const LargeArray<Place>& place, const std::vector<std::int32_t>& members);

    // The members by box; within a box by rising index.
    const std::vector<std::int32_t>& in_order() const { return in_order_; }

    // Calls each(first, last) for ranges of members. Together they hold the members of all boxes within
    // `reach` (m) of a place along each axis, and no member twice. With `onwards`, boxes that come before the
    // box of the place in the grid's order may be left out.
    template <class Each>
    void near(const Vec3& centre, double reach, bool onwards, const Each& each) const {
        if (none_near(centre, reach)) return;
        const std::array<int, 2> x = boxes(centre, reach, 0), y = boxes(centre, reach, 1),
                                 z = boxes(centre, reach, 2);
        const int last = count_[0] - 1;
        const bool leave_out = onwards && is_one_tile();
        const int own_y = leave_out ? box_of(centre, 1) : 0, own_z = leave_out ? box_of(centre, 2) : 0;
        for (int row_z = std::max(z[0], own_z); row_z <= std::min(z[1], count_[2] - 1); ++row_z) {
            const int first_y = std::max(y[0], row_z == own_z ? own_y : 0);
            for (int row_y = first_y; row_y <= std::min(y[1], count_[1] - 1); ++row_y) {
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

    // Whether the rows of boxes follow each other in the order in which they lie in space.
    bool is_one_tile() const { return tile_bits_ == kOneTileBits; }

  private:
    // First and last box within `reach` along the a-th axis. They may lie outside the grid, by at most one
    // period.
    std::array<int, 2> boxes(const Vec3& centre, double reach, int a) const {
        const double at = centre[axes_[a]] - origin_[a];
        return {box(at - reach, a), box(at + reach, a)};
    }
    // A position that is not a number, in a bed that blows up, goes to the first box. The health check will
    // report it.
    int box(double at, int a) const {
        const double count = count_[a];
        return static_cast<int>(std::max(0.0, std::min(at * inverse_width_[a] + count, 3 * count))) -
               count_[a];
    }
    int box_of(const Vec3& position, int a) const {
        return std::clamp(box(position[axes_[a]] - origin_[a], a), 0, count_[a] - 1);
    }
    std::int64_t box_of(const Vec3& position) const {
        return index(box_of(position, 0), box_of(position, 1), box_of(position, 2));
    }
    bool none_near(const Vec3& centre, double reach) const {
        return !is_near_.empty() && reach <= width_ && !is_near_[box_of(centre)];
    }
    // Rows of boxes along the fastest axis follow each other tile by tile. So the rows around a row are still
    // in the processor's cache when they are needed again. A small grid is one tile. Threads then share it in
    // slices, and few grains have partners of another thread.
    static constexpr int kTileBits = 3, kOneTileBits = 30;
    std::int64_t index(int x, int y, int z) const {
        if (is_one_tile()) return (static_cast<std::int64_t>(z) * count_[1] + y) * count_[0] + x;
        const int tile_y = y >> tile_bits_ << tile_bits_, tile_z = z >> tile_bits_ << tile_bits_;
        const int wide = std::min(1 << tile_bits_, count_[1] - tile_y),
                  high = std::min(1 << tile_bits_, count_[2] - tile_z);
        const std::int64_t row = static_cast<std::int64_t>(tile_z) * count_[1] + tile_y * high +
                                 (z - tile_z) * wide + (y - tile_y);
        return row * count_[0] + x;
    }

    std::array<int, 3> axes_{0, 1, 2};
    Vec3 origin_{0, 0, 0}, inverse_width_{0, 0, 0};  // along axes_
    std::array<int, 3> count_{1, 1, 1};              // as above
    int tile_bits_ = kTileBits;                      // a tile's side has 2^tile_bits_ rows
    bool periodic_ = false;
    std::vector<std::int32_t> start_;  // first member of each box, and one past the last
    std::vector<std::int32_t> in_order_;
    std::vector<std::int32_t> box_;  // one for each member, while sorting
    double width_ = 0;               // m: no box is narrower
    std::vector<bool> is_near_;      // whether a box or one next to it has members; empty: not known
};

class Cells {
  public:
    // Finds a new order of the grains: in_order()[new] = old. It follows the boxes of the level that has most
    // grains, slowest along the bed's longest side. So grains that touch lie close in memory, and few
    // contacts are between grains of two threads. The bits of a run depend on this order, because it is the
    // order in which forces are summed. `skin` is in m, and `period` is as in GridLayout. in_order() is valid
    // until lay().
    void order(const LargeArray<Place>& place, double skin, double period);
    const std::vector<std::int32_t>& in_order() const { return levels_[leading_].grid.in_order(); }

    // Lays the grids over the same grains, once they have been put in that order.
    void lay(const LargeArray<Place>& place, double skin);

    struct Level {
        std::vector<std::int32_t> members;
        double largest = 0;  // m, radius
        Grid grid;
        bool rising = false;  // indices rise in the grid's own order
        bool leads = false;   // all grains are in the order of this grid's boxes
    };
    const std::vector<Level>& levels() const { return levels_; }

  private:
    static constexpr int kOctaves = 64;

    void find_levels(const LargeArray<Place>& place);
    void find_members();

    std::vector<Level> levels_;                      // the levels that have members
    std::size_t leading_ = 0;                        // the level with most members
    std::vector<std::uint8_t> octave_of_;            // one for each grain before they were put in order
    std::array<std::uint8_t, kOctaves> level_of_{};  // one for each octave
    GridLayout frame_;
};

}  // namespace grainreel
