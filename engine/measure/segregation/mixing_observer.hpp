// How well big grains are mixed with all others, by samples of equal count.
#pragma once

#include <algorithm>
#include <numeric>

#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/measure/segregation/segregation.hpp"

namespace grainreel::observers {

class Mixing final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"lacey", "Lacey mixing index"}}, "1", "Lacey's mixing index: 0 segregated, 1 randomly mixed"},
            {{{"intensity", "intensity of segregation"}},
             "1",
             "intensity of segregation by Danckwerts, from the samples of `lacey`: 1 segregated, about "
             "1/32 randomly mixed"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 2);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const Grains& grains = m.grains;
        std::vector<std::size_t> by_id(grains.size());
        std::iota(by_id.begin(), by_id.end(), std::size_t{0});
        std::sort(by_id.begin(), by_id.end(), [&](auto a, auto b) { return grains.id[a] < grains.id[b]; });
        std::vector<Vec3> position;
        std::vector<std::uint8_t> marked;
        for (const std::size_t i : by_id) {
            position.push_back(grains.place[i].position);
            marked.push_back(static_cast<std::size_t>(grains.species[i]) == kinds.big);
        }
        const Samples samples = take_samples(position, marked);
        row.insert(row.end(), {lacey_index(samples), intensity_of_segregation(samples)});
    }
};

}  // namespace grainreel::observers
