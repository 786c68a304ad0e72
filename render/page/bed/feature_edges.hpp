// The edges of a mesh that are drawn as lines.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/surface.hpp"

namespace grainreel {

// Rims, edges of more than two triangles, and edges at which neighbours turn by more than 30 degrees: numbers
// of their two vertices.
std::vector<std::array<std::int32_t, 2>> feature_edges(const Surface& surface);

}  // namespace grainreel
