// How many of the big grains lie on top.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/measure/big_and_small.hpp"
#include "engine/measure/heights.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation.hpp"

namespace grainreel::observers {

class BigInTopQuarter final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"big_in_top_quarter", "big grains in top quarter"}},
                 "1",
                 "share of the largest species' grains whose centres lie above 3/4 of the bed's height"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return row.push_back(std::numeric_limits<double>::quiet_NaN());
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const std::vector<double> big = heights_above(m.grains, m.floor_height(), kinds.big);
        std::vector<double> all = heights_above(m.grains, m.floor_height());
        const double limit = 0.75 * bed_height(all);
        const auto higher = std::count_if(big.begin(), big.end(), [&](double h) { return h > limit; });
        row.push_back(static_cast<double>(higher) / static_cast<double>(big.size()));
    }
};

}  // namespace grainreel::observers
