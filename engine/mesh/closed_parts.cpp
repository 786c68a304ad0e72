#include "engine/mesh/closed_parts.hpp"

#include "engine/mesh/disjoint_sets.hpp"
#include "engine/mesh/edge_table.hpp"

namespace grainreel {

std::vector<char> in_closed_part(const TriangleMesh& mesh) {
    DisjointSets parts(mesh.triangles.size());
    std::vector<std::int32_t> open;  // triangles on edges that are run through unevenly
    EdgeTable(mesh).each([&](std::int32_t low, std::span<const EdgeSide> sides) {
        int sum = 0;
        for (const EdgeSide& side : sides) {
            sum += begin_of(mesh, side.side) == low ? 1 : -1;
            if (&side != &sides[0]) parts.join(sides[0].side / 3, side.side / 3);
        }
        if (sum != 0) open.push_back(sides[0].side / 3);
    });
    std::vector<char> part_closed(mesh.triangles.size(), 1), closed(mesh.triangles.size());
    for (const std::int32_t triangle : open) part_closed[static_cast<std::size_t>(parts.root(triangle))] = 0;
    for (std::size_t t = 0; t < closed.size(); ++t)
        closed[t] = part_closed[static_cast<std::size_t>(parts.root(static_cast<std::int32_t>(t)))];
    return closed;
}

}  // namespace grainreel
