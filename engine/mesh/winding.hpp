// Which side of a surface is which: neighbours are brought to the same order of corners.
#pragma once

#include <cstdint>

#include "engine/mesh/edge_table.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

struct Winding {
    std::int64_t flipped = 0;  // triangles that were turned round
    std::int64_t solids = 0;   // parts that hang together by edges
    std::int64_t open_edges = 0, crowded_edges = 0;
};

// Makes the order consistent over edges of two triangles. The order that most triangles of a part have stays:
// it says more than whether the part is closed, for the inner side of a hollow wall is closed and rightly
// faces inwards. Only where a closed part is so mixed that its order says nothing (more than a quarter must
// be turned) it comes to face outwards. A part that cannot be oriented (a Moebius strip) stays as it is.
Winding wind_alike(TriangleMesh& mesh);

}  // namespace grainreel
