// Joins vertices that are close to each other.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// Vertices to be joined: two that lie within `reach` (m) of each other, and within the room that each of them
// has.
struct Welding {
    const std::vector<Vec3>& vertices;
    double reach = 0;
    std::vector<double> room;  // m, by vertices; empty: only `reach` counts
};
// Looks at those named in `which` (all different, rising). Gives for each vertex the one that takes its
// place: itself, or the first one looked at that it can be joined with.
std::vector<std::int32_t> joined(const Welding& welding, const std::vector<std::int32_t>& which);

// Gives the triangles the vertices that take the place of theirs. Returns how many vertices went.
std::int64_t replace_vertices(TriangleMesh& mesh, const std::vector<std::int32_t>& place_of);

// Leaves out vertices that no triangle has; the rest come in the order in which the triangles name them.
void drop_unused_vertices(TriangleMesh& mesh);

}  // namespace grainreel
