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

// The cells within the cutoff of a box, and what each of them adds to an index of the grid, axis by axis: -1
// beyond the grid's edge.
void Footprint::set_box(const Vec3& low, const Vec3& high) {
    std::int64_t stride = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const int axis = static_cast<int>(k);
        box_[k] = range_of(k, low[axis] - kernel_.cutoff(), high[axis] + kernel_.cutoff());
        offsets_[k].clear();
        for (std::int64_t cell = box_[k].begin; cell < box_[k].end; ++cell) {
            const std::int64_t in_grid = inside(grid_.axes[k], cell);
            offsets_[k].push_back(in_grid < 0 ? -1 : in_grid * stride);
        }
        stride *= grid_.axes[k].count;
    }
}

// Of the distance along one axis between a point and the middles of cells.
void Footprint::set_squares(std::size_t k, Range range, double point) {
    const GridAxis& axis = grid_.axes[k];
    squares_[k].clear();
    for (std::int64_t cell = range.begin; cell < range.end; ++cell) {
        const double away = axis.resolved ? axis.middle(cell) - point : 0;
        squares_[k].push_back(away * away);
    }
}

// Adds the kernel about a point, times `share`, to the values of the box. Cells of one row lie side by side:
// along x, or along y where x is not resolved.
void Footprint::add_kernel(const Vec3& middle, double share) {
    std::array<Range, 3> near;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = middle[static_cast<int>(k)];
        near[k] = range_of(k, at - kernel_.cutoff(), at + kernel_.cutoff());
        set_squares(k, near[k], at);
    }
    const std::size_t along = grid_.axes[0].resolved ? 0 : 1, across = 1 - along;
    const std::int64_t width = box_[along].end - box_[along].begin,
                       layer = width * (box_[across].end - box_[across].begin);
    double* plane = values_.data() + (near[2].begin - box_[2].begin) * layer +
                    (near[across].begin - box_[across].begin) * width + near[along].begin - box_[along].begin;
    for (const double square_z : squares_[2]) {
        double* row = plane;
        for (const double square : squares_[across]) {
            const double away = square_z + square;
            for (std::size_t k = 0; k < squares_[along].size(); ++k)
                row[k] += share * kernel_.at(away + squares_[along][k]);
            row += width;
        }
        plane += layer;
    }
}

// The cells of the box that have a value, scaled. `value` is asked for each cell once, x fastest.
template <class Value>
std::span<const CellWeight> Footprint::collect(const Value& value) {
    cells_.resize(offsets_[0].size() * offsets_[1].size() * offsets_[2].size());
    CellWeight* next = cells_.data();
    double sum = 0;
    for (std::size_t z = 0; z < offsets_[2].size(); ++z)
        for (std::size_t y = 0; y < offsets_[1].size(); ++y)
            for (std::size_t x = 0; x < offsets_[0].size(); ++x) {
                const double here = value(x, y, z);
                if (here <= 0) continue;
                sum += here;
                const std::int64_t at_x = offsets_[0][x], at_y = offsets_[1][y], at_z = offsets_[2][z];
                if ((at_x | at_y | at_z) >= 0) *next++ = {at_x + at_y + at_z, here};
            }
    const std::span<CellWeight> found{cells_.data(), next};
    const double scale = 1 / (sum * grid_.cell_volume());
    for (CellWeight& cell : found) cell.weight *= scale;
    return found;
}

std::span<const CellWeight> Footprint::of_point(const Vec3& point) {
    set_box(point, point);
    for (std::size_t k = 0; k < 3; ++k) set_squares(k, box_[k], point[static_cast<int>(k)]);
    return collect([&](std::size_t x, std::size_t y, std::size_t z) {
        return kernel_.at(squares_[2][z] + squares_[1][y] + squares_[0][x]);
    });
}

std::span<const CellWeight> Footprint::of_line(const Vec3& begin, const Vec3& branch) {
    const Vec3 end = begin + branch;
    set_box(begin.cwiseMin(end), begin.cwiseMax(end));
    values_.assign(offsets_[0].size() * offsets_[1].size() * offsets_[2].size(), 0);
    const int stretches =
        std::max(1, static_cast<int>(std::ceil(branch.norm() / (longest_stretch * kernel_.width()))));
    for (int k = 0; k < stretches; ++k)
        for (const auto& [at, share] : quadrature) add_kernel(begin + (k + at) / stretches * branch, share);
    const double* next = values_.data();
    return collect([&](std::size_t, std::size_t, std::size_t) { return *next++; });
}

}  // namespace grainreel
