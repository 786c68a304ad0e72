// How much higher big grains lie than small ones.
#pragma once

#include "engine/measure/heights.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/measure/segregation/segregation.hpp"

namespace grainreel::observers {

class HeightDifference final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"height_difference", "height of big − small"}},
                 "1",
                 "`NAME_height_m` of the species of the largest mean diameter minus that of the smallest, "
                 "over the height above the floor below which 95 % of all centres lie; of species all equal "
                 "in size, the first minus the second"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 1);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const std::vector<double> mean = mean_heights(m.grains, m.scene.species.size(), m.floor_height());
        std::vector<double> heights = heights_above(m.grains, m.floor_height());
        row.push_back((mean[kinds.big] - mean[kinds.small]) / bed_height(heights));
    }
};

}  // namespace grainreel::observers
