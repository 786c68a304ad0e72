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

// Clears the values of the cells within the cutoff of a box, and notes what each of them adds to an index of
// the grid, axis by axis: -1 beyond the grid's edge.
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
    width_ = box_[along_].end - box_[along_].begin;
    layer_ = width_ * (box_[across_].end - box_[across_].begin);
    values_.assign(static_cast<std::size_t>(layer_ * (box_[2].end - box_[2].begin)), 0);
}

// Adds the kernel about a point, times `share`, to the values of the box, row by row. Of a row, only cells
// within the cutoff are visited.
void Footprint::add_kernel(const Vec3& middle, double share) {
    std::array<Range, 3> near;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = middle[static_cast<int>(k)];
        const GridAxis& axis = grid_.axes[k];
        near[k] = range_of(k, at - kernel_.cutoff(), at + kernel_.cutoff());
        squares_[k].clear();
        for (std::int64_t cell = near[k].begin; cell < near[k].end; ++cell) {
            const double away = axis.resolved ? axis.middle(cell) - at : 0;
            squares_[k].push_back(away * away);
        }
    }
    const std::vector<double>& squares = squares_[along_];
    factors_.clear();
    if (kernel_.is_product())
        for (const double square : squares) factors_.push_back(kernel_.at(square));
    const double cutoff = kernel_.cutoff() * kernel_.cutoff();
    double* plane = values_.data() + (near[2].begin - box_[2].begin) * layer_ +
                    (near[across_].begin - box_[across_].begin) * width_ + near[along_].begin -
                    box_[along_].begin;
    for (const double square_z : squares_[2]) {
        double* row = plane;
        for (const double square : squares_[across_]) {
            const double away = square_z + square;
            std::size_t begin = 0, end = squares.size();
            while (begin < end && away + squares[begin] >= cutoff) ++begin;
            while (begin < end && away + squares[end - 1] >= cutoff) --end;
            if (kernel_.is_product()) {
                const double factor = share * kernel_.at(away);
                for (std::size_t k = begin; k < end; ++k) row[k] += factor * factors_[k];
            } else {
                for (std::size_t k = begin; k < end; ++k) row[k] += share * kernel_.at(away + squares[k]);
            }
            row += width_;
        }
        plane += layer_;
    }
}

// The cells of the box that have a value, scaled.
std::span<const CellWeight> Footprint::collect() {
    cells_.resize(values_.size());
    double sum = 0;
    const double* value = values_.data();
    const std::int64_t* const offsets = offsets_[along_].data();
    CellWeight* next = cells_.data();
    for (const std::int64_t z : offsets_[2])
        for (const std::int64_t other : offsets_[across_])
            for (std::int64_t k = 0; k < width_; ++k) {
                const double here = *value++;
                if (here <= 0) continue;
                sum += here;
                if ((z | other | offsets[k]) >= 0) *next++ = {z + other + offsets[k], here};
            }
    const std::span<CellWeight> found{cells_.data(), next};
    const double scale = 1 / (sum * grid_.cell_volume());
    for (CellWeight& cell : found) cell.weight *= scale;
    return found;
}

std::span<const CellWeight> Footprint::of_point(const Vec3& point) {
    set_box(point, point);
    add_kernel(point, 1);
    return collect();
}

std::span<const CellWeight> Footprint::of_line(const Vec3& begin, const Vec3& branch) {
    const Vec3 end = begin + branch;
    set_box(begin.cwiseMin(end), begin.cwiseMax(end));
    const int stretches =
        std::max(1, static_cast<int>(std::ceil(branch.norm() / (longest_stretch * kernel_.width()))));
    for (int k = 0; k < stretches; ++k)
        for (const auto& [at, share] : quadrature) add_kernel(begin + (k + at) / stretches * branch, share);
    return collect();
}

}  // namespace grainreel
