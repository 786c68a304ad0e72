// The cells of a grid over which a grain or a contact is spread, and their weights.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/measure/fields/field_grid.hpp"

namespace grainreel {

struct CellWeight {
    std::int64_t cell;  // index in the grid
    double weight;      // 1/m3
};

struct CellWay {
    std::int64_t cell;
    Vec3 way;  // 1/m2, the weight of a contact, a vector
};

// The weights are the kernel's values at the middles of the cells, scaled so that the sum of weight times
// volume is 1 over all cells that the kernel reaches, including cells beyond the edge of the grid. So the
// spread quantity is conserved to rounding, whatever the size of the cells. The kernel's width is that of
// kernel_width() for the given radius (m). A result is valid until the next call.
class Footprint {
  public:
    Footprint(const FieldGrid& grid, const FieldKernel& kernel)
        : grid_(grid), kernel_(kernel), along_(grid.axes[0].resolved ? 0 : 1), across_(1 - along_) {}

    // Weights of the kernel about a point.
    std::span<const CellWeight> of_point(const Vec3& point, double radius = 0);
    // Weights of the kernel's mean along a straight line: the integral over s from 0 to 1 of W(r - begin - s
    // branch), by Gauss-Legendre quadrature of four points in each stretch of at most 2.5 widths. The error
    // is below 1e-4 of the kernel's largest value, except where the Gaussian is cut off, at 1 % of that
    // value.
    std::span<const CellWeight> of_line(const Vec3& begin, const Vec3& branch, double radius = 0);
    // The same for a line along which the kernel W_s changes its width w_s evenly, from the width for one
    // radius to that for the other. The weights are the integral over s of W_s (branch + (r - begin - s
    // branch) d(ln w_s)/ds). Its divergence is the kernel at the beginning minus the kernel at the end. Its
    // sum times volume is the branch.
    std::span<const CellWay> of_changing_line(const Vec3& begin, const Vec3& branch, double radius,
                                              double other_radius);
    // Whether grains of these radii have kernels of different widths.
    bool differ(double radius, double other_radius) const {
        return stretch_of(radius) != stretch_of(other_radius);
    }

  private:
    struct Range {
        std::int64_t begin = 0, end = 1;  // numbers of cells, also beyond the edge of the grid
        std::size_t size() const { return static_cast<std::size_t>(end - begin); }
    };
    Range range_of(std::size_t axis, double low, double high) const;
    // Ratio of the width of a grain's kernel to kernel_.width().
    double stretch_of(double radius) const { return kernel_width(kernel_.width(), radius) / kernel_.width(); }
    void set_box(const Vec3& low, const Vec3& high);
    void set_box(const Vec3& begin, const Vec3& end, double stretch, double end_stretch);
    int stretches_of(const Vec3& branch, double stretch) const;
    template <class Each>
    void each_near(const Vec3& middle, double stretch, const Each& each);
    template <class Rows>
    std::span<const CellWeight> listed(const Rows& rows);
    std::span<const CellWay> listed_ways(const Vec3& branch);

    const FieldGrid& grid_;
    FieldKernel kernel_;
    // Cells of a row lie side by side: along x, or along y where x is not resolved.
    std::size_t along_, across_;
    std::array<Range, 3> box_{};
    std::array<std::vector<std::int64_t>, 3> offsets_;
    std::vector<double> values_;                  // values of the box, row by row
    std::array<std::vector<double>, 3> squares_;  // m2, distances along an axis
    std::vector<double> factors_;                 // factors along a row, for a kernel that is a product
    std::vector<double> flows_;  // four numbers for each cell of the box: x, y and z of the drift, then the
                                 // weight
    std::vector<CellWeight> cells_;
    std::vector<CellWay> ways_;
};

}  // namespace grainreel
