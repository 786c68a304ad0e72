// Where the grains of each species are on average, each counted alike.
#pragma once

#include "engine/measure/heights.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class SpeciesPlaces final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene& scene) {
        std::vector<ColumnGroup> groups;
        for (const Species& species : scene.species) {
            const std::string& name = species.name;
            ColumnGroup centre{{}, "m", "mean position of a species, every grain counted alike"};
            for (const char* axis : {"x", "y", "z"})
                centre.columns.push_back({column_part(name) + "_centre_" + axis + "_m",
                                          "centre of " + name + ", " + axis, Dimension::length});
            groups.push_back(std::move(centre));
            groups.push_back(
                {{{column_part(name) + "_height_m", "mean height of " + name, Dimension::length}},
                 "m",
                 "mean height of its centres above the floor where the floor is now"});
        }
        return groups;
    }
    void look(const Moment& m, std::vector<double>& row) override {
        const std::size_t species = m.scene.species.size();
        std::vector<Vec3> centre(species, Vec3::Zero());
        std::vector<double> count(species, 0);
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            const auto s = static_cast<std::size_t>(m.grains.species[i]);
            centre[s] += m.grains.place[i].position;
            count[s] += 1;
        }
        const std::vector<double> height = mean_heights(m.grains, species, m.floor_height());
        for (std::size_t s = 0; s < species; ++s) {
            centre[s] /= count[s];
            row.insert(row.end(), {centre[s].x(), centre[s].y(), centre[s].z(), height[s]});
        }
    }
};

}  // namespace grainreel::observers
