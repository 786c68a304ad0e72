// Profiles: fields in the (y, z) plane as means along one direction, against the place along the other.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/measure/fields/coarse_graining.hpp"

namespace grainreel {

// Axes of a grid that is not resolved along x.
enum class ProfileAxis : std::size_t { across = 1, height = 2 };

// The mean of `values` over all cells at each place, weighted by `weights`; cells without a value (NaN) have
// no say, and a place without weight is NaN.
std::vector<double> profile_of(const CellValues& values, const CellValues& weights, const FieldGrid& grid,
                               ProfileAxis axis);

// The solid fraction of each species: volume of its grains over the volume inside the container.
std::vector<std::vector<double>> solid_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis);
// The share of each species in the solid volume; NaN where there is none.
std::vector<std::vector<double>> share_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis);
// m/s, momentum over mass of all grains there. component: 0, 1, 2 for x, y, z.
std::vector<double> velocity_profile(const CoarseFields& fields, const CoarseGraining& by, ProfileAxis axis,
                                     std::size_t component);

}  // namespace grainreel
