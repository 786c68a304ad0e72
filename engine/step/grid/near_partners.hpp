// Who of a grain's surroundings is near enough for its neighbour list.
#pragma once

#include <cstdint>

#include "engine/state/grains.hpp"

namespace grainreel {

// So many numbers behind the candidates keep_near() may read and write.
constexpr std::int32_t kNearSlack = 16;

// Of `count` candidates those above i that are closer to it than the sum of both radii and `skin` (m) move to
// the front, in their order. How many they are. period: m, of x; 0 for none.
std::int32_t keep_near(const Grains& grains, std::int32_t i, double skin, double period,
                       std::int32_t* candidates, std::int32_t count);

}  // namespace grainreel
