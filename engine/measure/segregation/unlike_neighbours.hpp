// Whether grains of different species lie side by side as often as by chance, and the search for neighbours
// that this needs.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/grid/cells.hpp"

namespace grainreel {

// Neighbours are grains whose surfaces are closer than this, over the smallest species' mean diameter.
inline constexpr double kNeighbourGap = 0.25;

// The share that pairs of different species have in all pairs of neighbours, over the share they would have
// by chance: 0 apart, 1 mixed at random, above 1 in order. It is 1 - a with a the order parameter of alloys
// (Cowley 1950, Phys. Rev. 77, 669), whose atoms are of one size. Here sizes differ, and a large grain has
// more neighbours: by chance, two grains are neighbours with a weight of (r_i + r_j)^2, as the surface on
// which the centre of one that touches the other can lie. That weight is ours; for grains of one size it is
// 1, and chance is that of all ways to hand out the labels again.
//
// Species go with the places. gap: m, between surfaces. period: m, of x; 0 for none. NaN without neighbours,
// or where all grains are of one species.
double unlike_neighbours(const LargeArray<Place>& place, const std::vector<std::int32_t>& species, double gap,
                         double period);

// All pairs of grains whose surfaces are closer than a gap.
inline bool are_neighbours(const Place& a, const Place& b, double gap, double period) {
    Vec3 apart = a.position - b.position;
    apart.x() = nearest_image(apart.x(), period);
    const double reach = a.radius + b.radius + gap;
    return apart.squaredNorm() < reach * reach;
}

class NeighbourPairs {
  public:
    // gap: m. period: m, of x; 0 for none.
    NeighbourPairs(const LargeArray<Place>& place, double gap, double period) : gap_(gap), period_(period) {
        LargeArray<Place> wrapped = place;
        if (period > 0) {
            for (Place& p : wrapped) p.position.x() = nearest_image(p.position.x(), period);
        }
        cells_.order(wrapped, gap, period);
        order_ = cells_.in_order();
        for (const std::int32_t old : order_) place_.push_back(wrapped[old]);
        cells_.lay(place_, gap);
    }

    // see(a, b) for each pair once, by places in the array that was given.
    template <class See>
    void each(const See& see) const {
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(place_.size()); ++i) {
            const Place& own = place_[i];
            for (const Cells::Level& level : cells_.levels()) {
                level.grid.near(own.position, own.radius + gap_ + level.largest, level.leads,
                                [&](const std::int32_t* first, const std::int32_t* last) {
                                    for (; first < last; ++first)
                                        if (*first > i && are_neighbours(own, place_[*first], gap_, period_))
                                            see(order_[i], order_[*first]);
                                });
            }
        }
    }

  private:
    const double gap_, period_;
    Cells cells_;
    std::vector<std::int32_t> order_;  // by the order of the cells, which find partners fast only there
    LargeArray<Place> place_;          // as above
};

}  // namespace grainreel
