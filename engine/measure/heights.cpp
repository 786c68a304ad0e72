#include "engine/measure/heights.hpp"

namespace grainreel {

std::vector<double> heights_above(const Grains& grains, double floor, std::optional<std::size_t> species) {
    std::vector<double> heights;
    for (std::size_t i = 0; i < grains.size(); ++i)
        if (!species || static_cast<std::size_t>(grains.species[i]) == *species)
            heights.push_back(grains.place[i].position.z() - floor);
    return heights;
}

std::vector<double> mean_heights(const Grains& grains, std::size_t species, double floor) {
    std::vector<double> mean(species, 0), count(species, 0);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const auto s = static_cast<std::size_t>(grains.species[i]);
        mean[s] += grains.place[i].position.z() - floor;
        count[s] += 1;
    }
    for (std::size_t s = 0; s < species; ++s) mean[s] /= count[s];
    return mean;
}

}  // namespace grainreel
