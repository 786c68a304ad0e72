#include "engine/mesh/mesh_edges.hpp"

#include <algorithm>

namespace grainreel {

namespace {

bool before(const EdgeSide& a, const EdgeSide& b) {
    return a.high != b.high ? a.high < b.high : a.side < b.side;
}

// Sorts the edges at one vertex. As a rule they are few.
void sort_few(EdgeSide* first, EdgeSide* end) {
    constexpr std::ptrdiff_t few = 24;
    if (end - first > few) {
        std::sort(first, end, before);
        return;
    }
    for (EdgeSide* next = first + 1; next < end; ++next) {
        const EdgeSide moved = *next;
        EdgeSide* place = next;
        for (; place > first && before(moved, place[-1]); --place) *place = place[-1];
        *place = moved;
    }
}

}  // namespace

EdgeTable::EdgeTable(const TriangleMesh& mesh) : begins_(mesh.vertices.size() + 1, 0) {
    for (const TriangleMesh::Triangle& t : mesh.triangles)
        for (std::size_t e = 0; e < 3; ++e)
            ++begins_[static_cast<std::size_t>(std::min(t[e], t[(e + 1) % 3])) + 1];
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    sides_.resize(3 * mesh.triangles.size());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    std::int32_t side = 0;
    for (const TriangleMesh::Triangle& t : mesh.triangles)
        for (std::size_t e = 0; e < 3; ++e, ++side) {
            const std::int32_t a = t[e], b = t[(e + 1) % 3];
            sides_[next[std::min(a, b)]++] = {std::max(a, b), side};
        }
    for (std::size_t i = 0; i + 1 < begins_.size(); ++i)
        if (begins_[i + 1] - begins_[i] > 1)
            sort_few(sides_.data() + begins_[i], sides_.data() + begins_[i + 1]);
}

std::vector<char> in_closed_part(const TriangleMesh& mesh) {
    DisjointSets parts(mesh.triangles.size());
    std::vector<std::int32_t> open;  // triangles on edges that are not run through equally often both ways
    EdgeTable(mesh).each([&](std::int32_t low, std::span<const EdgeSide> sides) {
        int sum = 0;
        for (const EdgeSide& side : sides) {
            sum += begin_of(mesh, side.side) == low ? 1 : -1;
            if (&side != &sides[0]) parts.join(sides[0].side / 3, side.side / 3);
        }
        if (sum != 0) open.push_back(sides[0].side / 3);
    });
    std::vector<char> part_closed(mesh.triangles.size(), 1), closed(mesh.triangles.size());
    for (const std::int32_t triangle : open) part_closed[parts.root(triangle)] = 0;
    for (std::size_t t = 0; t < closed.size(); ++t)
        closed[t] = part_closed[parts.root(static_cast<std::int32_t>(t))];
    return closed;
}

}  // namespace grainreel
