// How many of the big grains lie beside the left and right walls.
#pragma once

#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/measure/segregation/side_walls.hpp"

namespace grainreel::observers {

class BigAtWalls final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"big_at_walls", "big grains beside the walls"}},
             "1",
             "share of the largest species' grains beside the left or right wall or slant, or a cylinder's "
             "wall: no grain of the smallest mean diameter fits between"}};
    }
    BigAtWalls(const Scene& scene, const Plan&) : walls_(scene) {}

    void look(const Moment& m, std::vector<double>& row) override {
        if (!m.has_two_kinds() || !walls_.any()) return add_no_values(row, 1);
        const auto big = static_cast<std::int32_t>(big_and_small(m.scene.species).big);
        double beside = 0, all = 0;
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            if (m.grains.species[i] != big) continue;
            all += 1;
            beside += walls_.side_of(m.grains.place[i], m.pose) != Side::none;
        }
        row.push_back(beside / all);
    }

  private:
    const SideWalls walls_;
};

}  // namespace grainreel::observers
