// A surface of triangles, as it comes from a file and as it is drawn.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// Each triangle names three vertices (m). Their order gives the side: it is counter-clockwise for an eye that
// the normal points to.
struct TriangleMesh {
    using Triangle = std::array<std::int32_t, 3>;
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    bool empty() const { return triangles.empty(); }
};

}  // namespace grainreel
