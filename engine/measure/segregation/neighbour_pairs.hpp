// All pairs of grains whose surfaces are closer than a gap.
#pragma once

#include <cstdint>

#include "engine/base/numbers.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/grid/cells.hpp"

namespace grainreel {

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
