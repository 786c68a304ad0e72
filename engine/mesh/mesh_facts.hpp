// What is known of a mesh that was read from a file: its format, its size, and what was mended.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// Facts about a mesh after it has been read and mended.
struct MeshFacts {
    std::string format;                        // "binary STL", "ASCII STL", "OBJ", "PLY"
    std::int64_t read = 0;                     // triangles in the file; a quad counts as two
    std::int64_t triangles = 0, vertices = 0;  // numbers after mending
    Vec3 low{0, 0, 0}, high{0, 0, 0};          // m, corners of the box around it, before anything moves
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
