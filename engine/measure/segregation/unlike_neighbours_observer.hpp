// Do grains of different species lie side by side as often as by chance?
#pragma once

#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/measure/segregation/unlike_neighbours.hpp"

namespace grainreel::observers {

class Unlike final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"unlike_neighbours", "unlike pairs / chance"}},
                 "1",
                 "pairs of neighbours of different species over what chance would give: 0 segregated, 1 "
                 "randomly mixed"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 1);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const double gap = kNeighbourGap * m.scene.species[kinds.small].diameter.mean;
        row.push_back(unlike_neighbours(m.grains.place, m.grains.species, gap, m.period));
    }
};

}  // namespace grainreel::observers
