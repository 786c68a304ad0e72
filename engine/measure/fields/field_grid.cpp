#include "engine/measure/fields/field_grid.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/bed.hpp"

namespace grainreel {

std::vector<double> GridAxis::middles() const {
    std::vector<double> all;
    for (std::int64_t k = 0; k < count; ++k) all.push_back(middle(k));
    return all;
}

int FieldGrid::dimensions() const {
    return static_cast<int>(
        std::count_if(axes.begin(), axes.end(), [](const GridAxis& axis) { return axis.resolved; }));
}

namespace {

// Whole cells from wall to wall, none larger than wanted.
GridAxis axis_between(double low, double high, double wanted) {
    GridAxis axis;
    axis.count = std::max<std::int64_t>(1, std::llround(std::ceil((high - low) / wanted * (1 - 1e-12))));
    axis.cell = (high - low) / static_cast<double>(axis.count);
    axis.low = low;
    return axis;
}

void pad(GridAxis& axis, double reach) {
    const std::int64_t more = std::llround(std::ceil(reach / axis.cell));
    axis.low -= static_cast<double>(more) * axis.cell;
    axis.count += 2 * more;
}

}  // namespace

FieldGrid make_field_grid(const Scene& scene, const FieldOutput& fields) {
    const Extent extent = extent_of(scene);
    const bool has_walls = scene.container.shape != Container::Shape::none;
    FieldGrid grid;
    grid.axes[0].resolved = fields.grid == FieldOutput::Grid::xyz;
    const FieldKernel kernel(fields.kernel, kernel_width(fields.width, 0.5 * largest_diameter(scene)),
                             grid.axes[0].resolved ? 3 : 2);
    for (int k = 0; k < 3; ++k) {
        const bool resolved = grid.axes[k].resolved;
        const double length = extent.high[k] - extent.low[k];
        GridAxis axis = axis_between(extent.low[k], extent.high[k], resolved ? fields.cell : length);
        axis.resolved = resolved;
        axis.periodic = k == 0 && scene.container.periodic_depth;
        if (has_walls && resolved && !axis.periodic) pad(axis, kernel.cutoff());
        grid.axes[k] = axis;
    }
    return grid;
}

namespace {

constexpr double gaussian_cutoff = 3;  // widths

// Over the standard deviation along one axis: from the mean of r2, 5/28 of the squared cutoff in two
// dimensions and 1/4 in three, shared out among the axes.
double lucy_cutoff(int dimensions) {
    return dimensions == 2 ? std::sqrt(56.0 / 5) : std::sqrt(12.0);
}

}  // namespace

double kernel_value(FieldOutput::Kernel kind, double q) {
    if (kind == FieldOutput::Kernel::gaussian) return std::exp(-0.5 * std::pow(gaussian_cutoff * q, 2));
    return (1 + 3 * q) * std::pow(1 - q, 3);
}

FieldKernel::FieldKernel(FieldOutput::Kernel kind, double width, int dimensions)
    : is_product_(kind == FieldOutput::Kernel::gaussian),
      width_(width),
      cutoff_(width * (kind == FieldOutput::Kernel::lucy ? lucy_cutoff(dimensions) : gaussian_cutoff)),
      places_(kEntries / (cutoff_ * cutoff_)) {
    for (int k = 0; k <= kEntries; ++k)
        values_.push_back(kernel_value(kind, std::sqrt(static_cast<double>(k) / kEntries)));
    values_.insert(values_.end(), {0.0, 0.0});
}

}  // namespace grainreel
