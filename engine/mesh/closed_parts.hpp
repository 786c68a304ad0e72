// Which parts of a surface bound a solid.
#pragma once

#include <vector>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// For each triangle, whether its part (what hangs together by edges) is closed and consistently wound: each
// edge is run through as often one way as the other. Such a part has an inside, and rays tell it.
std::vector<char> in_closed_part(const TriangleMesh& mesh);

}  // namespace grainreel
