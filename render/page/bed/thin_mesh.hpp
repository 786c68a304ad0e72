// Fewer triangles of the same shape: the vertices in a cell of a cubic grid become one, their mean, and
// triangles that lose a corner go (Rossignac and Borrel 1993, Multi-resolution 3D approximations for
// rendering complex scenes).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

struct ThinnedMesh {
    TriangleMesh mesh;
    std::vector<std::int32_t>
        triangle_from;                      // of each triangle, the one of the whole mesh that it comes from
    std::vector<std::int32_t> vertex_into;  // of each vertex of the whole mesh, the one that has taken it
};

// At most so many triangles. A mesh that has no more comes back as it is.
ThinnedMesh thinned(const TriangleMesh& mesh, std::size_t most_triangles);

}  // namespace grainreel
