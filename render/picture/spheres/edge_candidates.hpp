// Who may be seen in a pixel on an edge.
#pragma once

#include "render/picture/spheres/sphere_kernels.hpp"
#include "render/picture/spheres/visibility.hpp"

namespace grainreel {

// Puts pixel x, y and the different grains that it and its four neighbours show into place `at` of the block;
// `who`: their indices.
void take_candidates(const Visibility& visibility, const std::vector<ViewSphere>& spheres, int x, int y,
                     EdgeBlock& block, std::uint32_t (&who)[kCandidates][kPointBlock], int at);

// Nobody in the places from `begin` on.
void clear_candidates(EdgeBlock& block, int begin);

}  // namespace grainreel
