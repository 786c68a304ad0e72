// How far apart two sizes of grain are.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// Grains a sample of the Lacey index, on average; the index depends on it, so it is fixed.
inline constexpr int kLaceySample = 32;

// Lacey's mixing index M = (s0^2 - s^2) / (s0^2 - sr^2) with s0^2 = p (1 - p), sr^2 = s0^2 / n (Lacey 1954,
// J. Appl. Chem. 4, 257): 0 for full segregation, 1 for a random mixture. p is the number share of the marked
// grains, s^2 the variance of their share over samples of equal count n = kLaceySample (at least two
// samples), cut by halving the bed along its longest edge again and again. NaN when all or none are marked.
double lacey_index(const std::vector<Vec3>& position, const std::vector<std::uint8_t>& marked);

// m: height below which 95 % of the grains' centres lie; the bed height of the height difference. Reorders.
double bed_height(std::vector<double>& heights);

}  // namespace grainreel
