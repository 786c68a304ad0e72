// A triangle mesh as it is read from a file and as it is drawn, a table of its edges, and which of its parts
// are closed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
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

// Side e of triangle t runs from its corner e to its corner e + 1 and has the number 3 t + e.
struct EdgeSide {
    std::int32_t high;  // the vertex with the larger number
    std::int32_t side;
};

// The edges of a mesh. Each edge has all sides of triangles that lie on it.
class EdgeTable {
  public:
    explicit EdgeTable(const TriangleMesh& mesh);

    // Calls f(low vertex, sides) for each edge, by rising numbers of its vertices. The sides of an edge come
    // by rising number.
    template <class F>
    void each(F&& f) const {
        const std::span<const EdgeSide> all(sides_);
        for (std::size_t low = 0; low + 1 < begins_.size(); ++low) {
            std::size_t first = begins_[low];
            const std::size_t end = begins_[low + 1];
            while (first < end) {
                std::size_t last = first + 1;
                while (last < end && all[last].high == all[first].high) ++last;
                f(static_cast<std::int32_t>(low), all.subspan(first, last - first));
                first = last;
            }
        }
    }

  private:
    std::vector<std::size_t>
        begins_;  // for each vertex, the place of the first edge on which it is the lower vertex
    std::vector<EdgeSide> sides_;
};

// The vertex at which a side begins.
inline std::int32_t begin_of(const TriangleMesh& mesh, std::int32_t side) {
    return mesh.triangles[static_cast<std::size_t>(side / 3)][static_cast<std::size_t>(side % 3)];
}
inline std::int32_t end_of(const TriangleMesh& mesh, std::int32_t side) {
    return mesh.triangles[static_cast<std::size_t>(side / 3)][static_cast<std::size_t>((side + 1) % 3)];
}

// Sets of numbers that are joined step by step.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    // The lowest number of the set.
    std::int32_t root(std::int32_t i) {
        while (parent(i) != i) {
            parent(i) = parent(parent(i));
            i = parent(i);
        }
        return i;
    }
    // Joins the sets of a and b. Returns whether they were different sets.
    bool join(std::int32_t a, std::int32_t b) {
        a = root(a);
        b = root(b);
        parent(std::max(a, b)) = std::min(a, b);
        return a != b;
    }

  private:
    std::int32_t& parent(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }
    std::vector<std::int32_t> parent_;
};

// Whether the part of each triangle bounds a solid. A part is connected by edges. It bounds a solid if it is
// closed and consistently wound: its triangles run through each edge as often one way as the other. Rays can
// tell whether a place is inside such a part.
std::vector<char> in_closed_part(const TriangleMesh& mesh);

}  // namespace grainreel
