// How much of each cell of a grid is inside a vessel that is a mesh: lengths along rows of cells are exact
// between the places where the row meets the surface; across the rows the share is a mean over 16 of them.
#include <algorithm>
#include <cmath>

#include "engine/measure/fields/inside_mesh.hpp"
#include "engine/measure/walls/wall_bodies.hpp"

namespace grainreel {
namespace {

constexpr int kRows = 4;  // a cell, along y and along z

// A part of a row that is inside.
struct Piece {
    double from, to;  // m, x
};

// Between two crossings of the surface a row is inside or outside as a whole.
std::vector<Piece> pieces_inside(const Container& vessel, const Surface& surface, double low, double high,
                                 double y, double z) {
    std::vector<Surface::Hit> hits;
    surface.all_hits(Vec3(low, y, z), Vec3(1, 0, 0), hits);
    std::vector<double> ends{low};
    for (const Surface::Hit& hit : hits)
        if (low + hit.distance < high) ends.push_back(low + hit.distance);
    ends.push_back(high);
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        if (ends[k + 1] > ends[k] && vessel.room->holds(Vec3(0.5 * (ends[k] + ends[k + 1]), y, z)))
            pieces.push_back({ends[k], ends[k + 1]});
    return pieces;
}

double overlap(const Piece& piece, double begin, double end) {
    return std::max(0.0, std::min(piece.to, end) - std::max(piece.from, begin));
}

}  // namespace

std::vector<double> shares_inside_mesh(const FieldGrid& grid, const Scene& scene) {
    const auto& [x, y, z] = grid.axes;
    std::vector<double> shares(static_cast<std::size_t>(grid.cells()), 0.0);
    const std::optional<std::size_t> mesh = vessel_of(scene);
    if (!mesh) return shares;
    const double end = x.low + static_cast<double>(x.count) * x.cell;
    for (std::int64_t row = 0; row < z.count * y.count * kRows * kRows; ++row) {
        const std::int64_t k = row / (y.count * kRows * kRows), in_k = row % (y.count * kRows * kRows);
        const std::int64_t j = in_k / (kRows * kRows);
        const auto part = [](std::int64_t n) { return (static_cast<double>(n) + 0.5) / kRows; };
        const double at_y = y.low + (static_cast<double>(j) + part(in_k % kRows)) * y.cell;
        const double at_z = z.low + (static_cast<double>(k) + part(in_k / kRows % kRows)) * z.cell;
        if (at_z > scene.container.height) continue;
        for (const Piece& piece :
             pieces_inside(scene.container, *scene.meshes[*mesh].surface, x.low, end, at_y, at_z))
            for (std::int64_t i = 0; i < x.count; ++i) {
                const double begin = x.low + static_cast<double>(i) * x.cell;
                shares[static_cast<std::size_t>(grid.index(i, j, k))] +=
                    overlap(piece, begin, begin + x.cell) / (x.cell * kRows * kRows);
            }
    }
    return shares;
}

}  // namespace grainreel
