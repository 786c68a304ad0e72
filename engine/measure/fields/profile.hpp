// Profiles of fields in the (y, z) plane: means along one direction as functions of the place along the
// other.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/measure/fields/coarse_graining.hpp"

namespace grainreel {

// Axes of a grid that is not resolved along x.
enum class ProfileAxis : std::size_t { across = 1, height = 2 };

// The mean of `values` over all cells at each place, weighted by `weights`. Cells without a value (NaN) are
// left out, and a place without weight gives NaN.
std::vector<double> profile_of(const CellValues& values, const CellValues& weights, const FieldGrid& grid,
                               ProfileAxis axis);

// The solid fraction of each species: volume of its grains divided by the volume inside the container.
std::vector<std::vector<double>> solid_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis);
// The share of each species in the solid volume; NaN where there is none.
std::vector<std::vector<double>> share_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis);
// Velocity (m/s), momentum over mass of all grains at a place. `component` is 0, 1 or 2 for x, y or z.
std::vector<double> velocity_profile(const CoarseFields& fields, const CoarseGraining& by, ProfileAxis axis,
                                     std::size_t component);

}  // namespace grainreel
