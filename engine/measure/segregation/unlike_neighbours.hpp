// Tells whether grains of different species are neighbours as often as by chance, and contains the search for
// neighbours that this needs.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/grid/cells.hpp"

namespace grainreel {

// Neighbours are grains whose surfaces are closer than this, in units of the smallest species' mean diameter.
inline constexpr double kNeighbourGap = 0.25;

// The share of pairs of different species in all pairs of neighbours, divided by the share that they would
// have by chance. It is 0 if the species are apart, 1 if they are mixed at random, and above 1 if they
// alternate in order. It is 1 - a, where a is the order parameter of alloys (Cowley 1950, Phys. Rev. 77,
// 669). The atoms of an alloy have one size. Here sizes differ, and a large grain has more neighbours. So a
// pair counts with the weight (r_i + r_j)^2: the centre of a grain j that touches i lies on a sphere whose
// area is proportional to this. This weight is our own choice. For grains of one size all pairs have one
// weight, and chance then means all ways to permute the labels.
//
// `species` holds the species of the grain at each place, `gap` (m) is between surfaces, and `period` (m) is
// the period of x, or 0 where x is not periodic. NaN without neighbours, or if all grains are of one species.
double unlike_neighbours(const LargeArray<Place>& place, const std::vector<std::int32_t>& species, double gap,
                         double period);

// Whether the surfaces of two grains are closer than a gap.
inline bool are_neighbours(const Place& a, const Place& b, double gap, double period) {
    Vec3 apart = a.position - b.position;
    apart.x() = nearest_image(apart.x(), period);
    const double reach = a.radius + b.radius + gap;
    return apart.squaredNorm() < reach * reach;
}

class NeighbourPairs {
  public:
    // `gap` is in m, and `period` is the period of x in m, or 0.
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

    // Calls see(a, b) once for each pair of neighbours. a and b are their indices in the array given to the
    // constructor.
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
    std::vector<std::int32_t>
        order_;  // order of the grains by cells, because cells find partners fast only in this order
    LargeArray<Place> place_;  // places in the same order
};

}  // namespace grainreel
