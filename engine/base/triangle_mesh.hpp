// A triangle mesh as plain values: as it is read from a file, kept in a file, and drawn. The room engine/mesh
// mends such meshes and finds places on them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// Each triangle names three vertices (m). Their order gives the side: it is counter-clockwise as seen from
// the side to which the normal points.
struct TriangleMesh {
    using Triangle = std::array<std::int32_t, 3>;
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    bool empty() const { return triangles.empty(); }
};

}  // namespace grainreel
