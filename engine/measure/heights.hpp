// Heights of grains above the floor. m.
#pragma once

#include <optional>
#include <vector>

#include "engine/state/grains.hpp"

namespace grainreel {

// Heights of all grains' centres above the floor, or of those of one species. floor: m, its height.
std::vector<double> heights_above(const Grains& grains, double floor,
                                  std::optional<std::size_t> species = {});

// Mean of each of so many species.
std::vector<double> mean_heights(const Grains& grains, std::size_t species, double floor);

}  // namespace grainreel
