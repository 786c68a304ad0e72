#include "engine/measure/fields/kernel.hpp"

#include <cmath>

namespace grainreel {
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
