// The edges of a triangle mesh: a table of them, which triangles they join into parts, and which of these
// parts are closed. Only this room reads it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "engine/base/triangle_mesh.hpp"

namespace grainreel {

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
    return mesh.triangles[side / 3][side % 3];
}
inline std::int32_t end_of(const TriangleMesh& mesh, std::int32_t side) {
    return mesh.triangles[side / 3][(side + 1) % 3];
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
    std::int32_t& parent(std::int32_t i) { return parent_[i]; }
    std::vector<std::int32_t> parent_;
};

// Whether the part of each triangle bounds a solid. A part is connected by edges. It bounds a solid if it is
// closed and consistently wound: its triangles run through each edge as often one way as the other. Rays can
// tell whether a place is inside such a part.
std::vector<char> in_closed_part(const TriangleMesh& mesh);

}  // namespace grainreel
