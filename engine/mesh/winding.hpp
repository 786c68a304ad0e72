// Orients a mesh: gives neighbouring triangles the same order of corners, so that their normals agree.
#pragma once

#include <cstdint>

#include "engine/base/triangle_mesh.hpp"

namespace grainreel {

struct Winding {
    std::int64_t flipped = 0;  // triangles whose order was reversed
    std::int64_t solids = 0;   // parts connected by edges
    std::int64_t open_edges = 0, crowded_edges = 0;
};

// Makes the order consistent across edges of two triangles. The order that most triangles of a part have is
// kept, even if a closed part then faces inwards: the inner side of a hollow wall rightly does so. A closed
// part is made to face outwards only if its order is so mixed that more than a quarter of the triangles must
// be turned. A part that cannot be oriented (a Moebius strip) stays as it is.
Winding wind_alike(TriangleMesh& mesh);

}  // namespace grainreel
