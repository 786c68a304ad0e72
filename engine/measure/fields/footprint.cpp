#include "engine/measure/fields/footprint.hpp"

#include <array>
#include <cmath>

namespace grainreel {
namespace {

struct CellRange {
    std::int64_t begin, end;
};

// Cells whose middles may lie between low and high.
CellRange range_of(const GridAxis& axis, double low, double high) {
    if (!axis.resolved) return {0, 1};
    return {static_cast<std::int64_t>(std::floor((low - axis.low) / axis.cell)),
            static_cast<std::int64_t>(std::floor((high - axis.low) / axis.cell)) + 1};
}

// The cell of the grid that a number stands for; -1 beyond its edge.
std::int64_t inside(const GridAxis& axis, std::int64_t k) {
    if (axis.periodic) return ((k % axis.count) + axis.count) % axis.count;
    return k >= 0 && k < axis.count ? k : -1;
}

}  // namespace

// value(r): of the kernel at the middle of a cell, relative to the grid's axes; along directions that are not
// resolved r is 0.
template <class Value>
std::span<const CellWeight> Footprint::spread(const Vec3& low, const Vec3& high, const Value& value) {
    const auto& [x, y, z] = grid_.axes;
    const CellRange along_x = range_of(x, low.x(), high.x()), along_y = range_of(y, low.y(), high.y()),
                    along_z = range_of(z, low.z(), high.z());
    cells_.clear();
    double sum = 0;
    for (std::int64_t k = along_z.begin; k < along_z.end; ++k) {
        const std::int64_t cell_z = inside(z, k);
        for (std::int64_t j = along_y.begin; j < along_y.end; ++j) {
            const std::int64_t cell_y = inside(y, j);
            for (std::int64_t i = along_x.begin; i < along_x.end; ++i) {
                const double here = value(Vec3(x.resolved ? x.middle(i) : 0, y.middle(j), z.middle(k)));
                if (here <= 0) continue;
                sum += here;
                const std::int64_t cell_x = inside(x, i);
                if (cell_x >= 0 && cell_y >= 0 && cell_z >= 0)
                    cells_.push_back({grid_.index(cell_x, cell_y, cell_z), here});
            }
        }
    }
    for (CellWeight& cell : cells_) cell.weight /= sum * grid_.cell_volume();
    return cells_;
}

std::span<const CellWeight> Footprint::of_point(const Vec3& point) {
    Vec3 seen = point;
    if (!grid_.axes[0].resolved) seen.x() = 0;
    const Vec3 reach = kernel_.cutoff() * Vec3::Ones();
    return spread(seen - reach, seen + reach,
                  [&](const Vec3& r) { return kernel_.at((r - seen).squaredNorm()); });
}

std::span<const CellWeight> Footprint::of_line(const Vec3& begin, const Vec3& branch) {
    Vec3 from = begin, way = branch;
    if (!grid_.axes[0].resolved) from.x() = way.x() = 0;
    const double length = way.norm();
    if (length < 1e-9 * kernel_.cutoff()) return of_point(from);  // seen end-on
    const Vec3 direction = way / length, to = from + way, reach = kernel_.cutoff() * Vec3::Ones();
    return spread(from.cwiseMin(to) - reach, from.cwiseMax(to) + reach, [&](const Vec3& r) {
        const Vec3 away = r - from;
        const double ahead = away.dot(direction);
        const double square = std::max(0.0, away.squaredNorm() - ahead * ahead);
        return kernel_.along(square, -ahead, length - ahead);
    });
}

}  // namespace grainreel
