#include "engine/measure/fields/footprint.hpp"

#include <cmath>

namespace grainreel {
namespace {

constexpr double longest_stretch = 2.5;  // widths

// Points between 0 and 1 and their weights, of Gauss-Legendre quadrature (Abramowitz & Stegun, table 25.4).
constexpr std::array<std::array<double, 2>, 4> quadrature{
    {{0.5 * (1 - 0.8611363115940526), 0.5 * 0.3478548451374538},
     {0.5 * (1 - 0.3399810435848563), 0.5 * 0.6521451548625461},
     {0.5 * (1 + 0.3399810435848563), 0.5 * 0.6521451548625461},
     {0.5 * (1 + 0.8611363115940526), 0.5 * 0.3478548451374538}}};

// std::floor is a call where the program is built for any processor.
std::int64_t floor_of(double value) {
    const auto towards_zero = static_cast<std::int64_t>(value);
    return towards_zero - (value < static_cast<double>(towards_zero));
}

// The cell of the grid that a number stands for; -1 beyond its edge.
std::int64_t inside(const GridAxis& axis, std::int64_t k) {
    if (k >= 0 && k < axis.count) return k;
    return axis.periodic ? ((k % axis.count) + axis.count) % axis.count : -1;
}

}  // namespace

// All cells whose middles may lie between low and high; all of a direction that is not resolved.
Footprint::Range Footprint::range_of(std::size_t k, double low, double high) const {
    const GridAxis& axis = grid_.axes[k];
    if (!axis.resolved) return {};
    const double cells = 1 / axis.cell;
    return {floor_of((low - axis.low) * cells), floor_of((high - axis.low) * cells) + 1};
}

void Footprint::clear_box(const Vec3& low, const Vec3& high) {
    std::size_t size = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const int axis = static_cast<int>(k);
        box_[k] = range_of(k, low[axis] - kernel_.cutoff(), high[axis] + kernel_.cutoff());
        size *= static_cast<std::size_t>(box_[k].end - box_[k].begin);
    }
    values_.assign(size, 0);
}

// Adds its values about a point, times `share`. Cells of one row lie side by side: along x, or along y where
// x is not resolved.
void Footprint::add_kernel(const Vec3& middle, double share) {
    std::array<Range, 3> near;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = middle[static_cast<int>(k)];
        near[k] = range_of(k, at - kernel_.cutoff(), at + kernel_.cutoff());
    }
    const auto square = [&](std::size_t k, std::int64_t cell) {
        const GridAxis& axis = grid_.axes[k];
        const double away = axis.resolved ? axis.middle(cell) - middle[static_cast<int>(k)] : 0;
        return away * away;
    };
    const std::size_t along = grid_.axes[0].resolved ? 0 : 1, across = 1 - along;
    const Range row = near[along];
    squares_.clear();
    for (std::int64_t cell = row.begin; cell < row.end; ++cell) squares_.push_back(square(along, cell));
    const std::int64_t width = box_[along].end - box_[along].begin,
                       layer = width * (box_[across].end - box_[across].begin);
    for (std::int64_t z = near[2].begin; z < near[2].end; ++z)
        for (std::int64_t other = near[across].begin; other < near[across].end; ++other) {
            const double away = square(2, z) + square(across, other);
            double* const values = values_.data() + (z - box_[2].begin) * layer +
                                   (other - box_[across].begin) * width + row.begin - box_[along].begin;
            for (std::size_t k = 0; k < squares_.size(); ++k)
                values[k] += share * kernel_.at(away + squares_[k]);
        }
}

// What each cell of the box adds to an index of the grid, axis by axis; -1 beyond the grid's edge.
void Footprint::set_offsets() {
    std::int64_t stride = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        offsets_[k].clear();
        for (std::int64_t cell = box_[k].begin; cell < box_[k].end; ++cell) {
            const std::int64_t in_grid = inside(grid_.axes[k], cell);
            offsets_[k].push_back(in_grid < 0 ? -1 : in_grid * stride);
        }
        stride *= grid_.axes[k].count;
    }
}

// The cells of the box that have a value, scaled.
std::span<const CellWeight> Footprint::collect() {
    set_offsets();
    cells_.resize(values_.size());
    double sum = 0;
    const double* value = values_.data();
    CellWeight* next = cells_.data();
    for (const std::int64_t z : offsets_[2])
        for (const std::int64_t y : offsets_[1])
            for (const std::int64_t x : offsets_[0]) {
                const double here = *value++;
                if (here <= 0) continue;
                sum += here;
                if ((x | y | z) >= 0) *next++ = {x + y + z, here};
            }
    const std::span<CellWeight> found{cells_.data(), next};
    const double scale = 1 / (sum * grid_.cell_volume());
    for (CellWeight& cell : found) cell.weight *= scale;
    return found;
}

std::span<const CellWeight> Footprint::of_point(const Vec3& point) {
    clear_box(point, point);
    add_kernel(point, 1);
    return collect();
}

std::span<const CellWeight> Footprint::of_line(const Vec3& begin, const Vec3& branch) {
    const Vec3 end = begin + branch;
    clear_box(begin.cwiseMin(end), begin.cwiseMax(end));
    const int stretches =
        std::max(1, static_cast<int>(std::ceil(branch.norm() / (longest_stretch * kernel_.width()))));
    for (int k = 0; k < stretches; ++k)
        for (const auto& [at, share] : quadrature) add_kernel(begin + (k + at) / stretches * branch, share);
    return collect();
}

}  // namespace grainreel
