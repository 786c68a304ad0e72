// The edges of a mesh, each with all sides of triangles that lie on it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// Side e of triangle t runs from its corner e to its corner e + 1 and has the number 3 t + e.
struct EdgeSide {
    std::int32_t high;  // the vertex of the larger number
    std::int32_t side;
};

class EdgeTable {
  public:
    explicit EdgeTable(const TriangleMesh& mesh);

    // Calls f(low vertex, sides) for each edge, by rising numbers of its vertices; the sides rise too.
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
    std::vector<std::size_t> begins_;  // for each vertex, of the edges on which it is the lower one
    std::vector<EdgeSide> sides_;
};

// The vertex at which a side begins.
inline std::int32_t begin_of(const TriangleMesh& mesh, std::int32_t side) {
    return mesh.triangles[static_cast<std::size_t>(side / 3)][static_cast<std::size_t>(side % 3)];
}
inline std::int32_t end_of(const TriangleMesh& mesh, std::int32_t side) {
    return mesh.triangles[static_cast<std::size_t>(side / 3)][static_cast<std::size_t>((side + 1) % 3)];
}

}  // namespace grainreel
