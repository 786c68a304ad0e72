// Picks those grains around a grain that are near enough for its neighbour list.
#pragma once

#include <cstdint>

#include "engine/state/grains.hpp"

namespace grainreel {

// keep_near() may read and write this many numbers behind the candidates.
constexpr std::int32_t kNearSlack = 16;

// Moves the near candidates to the front, in their order, and returns how many they are. A candidate is near
// if its index is above i and its distance is less than the sum of both radii and `skin` (m).
// period: of x, in m; 0 for none.
std::int32_t keep_near(const Grains& grains, std::int32_t i, double skin, double period,
                       std::int32_t* candidates, std::int32_t count);

}  // namespace grainreel
