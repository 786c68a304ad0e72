// Finds the grains that overlap, from their places alone: for frames of other engines, which have no lists.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/state/grains.hpp"

namespace grainreel {

// Calls see() once for each pair that overlaps, with their indices and the overlap (m). period: of x in m; 0
// for none. Places may lie beyond the period. The order of the pairs depends only on the places.
void for_overlapping(const std::vector<Place>& places, double period,
                     const std::function<void(std::int32_t, std::int32_t, double)>& see);

}  // namespace grainreel
