// How high the bed is, and how dense.
#pragma once

#include "engine/measure/bed/solid_fraction.hpp"
#include "engine/measure/heights.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/segregation.hpp"

namespace grainreel::observers {

class BedShape final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"bed_top_m", "height of the bed", Dimension::length}},
             "m",
             "height above the floor below which 95 % of all centres lie"},
            {{{"bed_solid_fraction", "solid fraction of the bed"}},
             "1",
             "volume of the grains up to `bed_top_m` over that of the container between floor and there"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (m.grains.size() == 0) return add_no_values(row, 2);
        std::vector<double> heights = heights_above(m.grains, m.floor_height());
        const double height = bed_height(heights), top = m.floor_height() + height;
        row.insert(row.end(), {height, solid_fraction(m.scene.container, m.grains, m.pose.offset.z(), top)});
    }
};

}  // namespace grainreel::observers
