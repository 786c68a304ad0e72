// How far apart two kinds of grain are.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// Grains a sample of the Lacey index, on average; the index depends on it, so it is fixed.
inline constexpr int kLaceySample = 32;

// Of the rarer kind, on average a sample: with fewer there is no index. By chance one sample in exp(3) = 20
// then has none of them (Poisson), and what the samples hold no longer tells a layer from a mixture.
inline constexpr double kLeastOfRareKind = 3;

// Lacey's mixing index M = (s0^2 - s^2) / (s0^2 - sr^2) with s0^2 = p (1 - p), sr^2 = s0^2 / n (Lacey 1954,
// J. Appl. Chem. 4, 257): 0 for full segregation, 1 for a random mixture. p is the number share of the marked
// grains, s^2 the variance of their share over samples of equal count n = kLaceySample (at least two
// samples), cut by halving the bed along its longest edge again and again. NaN when the samples hold fewer
// than kLeastOfRareKind of the marked or of the others on average.
double lacey_index(const std::vector<Vec3>& position, const std::vector<std::uint8_t>& marked);

// Probability that one of `these` lies above one of `those`, equal heights counting half: Mann and Whitney's
// U over the number of pairs (1947, Ann. Math. Stat. 18, 50). 0 all below, 1/2 mixed, 1 all above; right for
// a single grain too. NaN when there are none of either. Reorders.
double share_above(std::vector<double>& these, std::vector<double>& those);

// m: height below which 95 % of the grains' centres lie; the bed height of the height difference. Grains in
// flight have no say in it. Reorders.
double bed_height(std::vector<double>& heights);

}  // namespace grainreel
