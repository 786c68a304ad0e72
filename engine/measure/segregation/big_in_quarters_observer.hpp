// How many of the big grains lie on top, and how many at the bottom.
#pragma once

#include <algorithm>

#include "engine/measure/heights.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/measure/segregation/segregation.hpp"

namespace grainreel::observers {

class BigInQuarters final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"big_in_top_quarter", "big grains in top quarter"}},
             "1",
             "share of the largest species' grains whose centres lie above 3/4 of the bed's height"},
            {{{"big_in_bottom_quarter", "big grains in bottom quarter"}}, "1", "the same below 1/4 of it"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 2);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const std::vector<double> big = heights_above(m.grains, m.floor_height(), kinds.big);
        std::vector<double> all = heights_above(m.grains, m.floor_height());
        const double bed = bed_height(all), count = static_cast<double>(big.size());
        const auto higher = std::count_if(big.begin(), big.end(), [&](double h) { return h > 0.75 * bed; });
        const auto lower = std::count_if(big.begin(), big.end(), [&](double h) { return h < 0.25 * bed; });
        row.insert(row.end(), {static_cast<double>(higher) / count, static_cast<double>(lower) / count});
    }
};

}  // namespace grainreel::observers
