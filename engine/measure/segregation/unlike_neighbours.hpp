// Do grains of different species lie side by side as often as by chance?
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"

namespace grainreel {

// Neighbours are grains whose surfaces are closer than this, over the smallest species' mean diameter.
inline constexpr double kNeighbourGap = 0.25;

// The share that pairs of different species have in all pairs of neighbours, over the share they would have
// by chance: 0 apart, 1 mixed at random, above 1 in order. It is 1 - a with a the order parameter of alloys
// (Cowley 1950, Phys. Rev. 77, 669), whose atoms are of one size. Here sizes differ, and a large grain has
// more neighbours: by chance, two grains are neighbours with a weight of (r_i + r_j)^2, as the surface on
// which the centre of one that touches the other can lie. That weight is ours; for grains of one size it is
// 1, and chance is that of all ways to hand out the labels again.
//
// Species go with the places. gap: m, between surfaces. period: m, of x; 0 for none. NaN without neighbours,
// or where all grains are of one species.
double unlike_neighbours(const LargeArray<Place>& place, const std::vector<std::int32_t>& species, double gap,
                         double period);

}  // namespace grainreel
