// A surface of triangles, as read from a file and as drawn.
#pragma once

#include <array>
#include <cstdint>
#include <string>
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

// Facts about a mesh after it has been read and mended.
struct MeshFacts {
    std::string format;                        // "binary STL", "ASCII STL", "OBJ", "PLY"
    std::int64_t read = 0;                     // triangles in the file; a quad counts as two
    std::int64_t triangles = 0, vertices = 0;  // numbers after mending
    Vec3 low{0, 0, 0}, high{0, 0, 0};          // m, corners of the box around it, at rest in the scene
    std::int64_t solids = 0;                   // connected parts
    std::int64_t open_edges = 0;               // edges of one triangle alone
    std::int64_t crowded_edges = 0;            // edges of more than two triangles
    std::int64_t slender = 0;                  // triangles whose height is below 1e-3 of their longest edge
    std::int64_t welded = 0;                   // vertices that were joined with others
    std::int64_t dropped = 0;                  // triangles without area
    std::int64_t doubled = 0;                  // repeated triangles
    std::int64_t flipped = 0;                  // triangles whose order was reversed
    std::vector<std::string> mended;           // one line for the user for each kind of fault that was mended

    bool closed() const { return open_edges == 0 && crowded_edges == 0; }
};

}  // namespace grainreel
