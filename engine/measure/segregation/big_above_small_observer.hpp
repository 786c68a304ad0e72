// How often a big grain lies above a small one.
#pragma once

#include "engine/measure/heights.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/measure/segregation/segregation.hpp"

namespace grainreel::observers {

class BigAboveSmall final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"big_above_small", "P(big above small)"}},
                 "1",
                 "probability that a grain of the largest species lies above one of the smallest: 0 all "
                 "below, 1/2 mixed, 1 all above"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 1);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        std::vector<double> big = heights_above(m.grains, m.floor_height(), kinds.big);
        std::vector<double> small = heights_above(m.grains, m.floor_height(), kinds.small);
        row.push_back(share_above(big, small));
    }
};

}  // namespace grainreel::observers
