#include "engine/measure/fields/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

constexpr double gaussian_cutoff = 3;  // widths

// Over the standard deviation along one axis: from the mean of r2, 5/28 of the squared cutoff in two
// dimensions and 1/4 in three, shared out among the axes.
double lucy_cutoff(int dimensions) {
    return dimensions == 2 ? std::sqrt(56.0 / 5) : std::sqrt(12.0);
}

}  // namespace

FieldKernel::FieldKernel(FieldOutput::Kernel kind, double width, int dimensions)
    : kind_(kind),
      width_(width),
      cutoff_(width * (kind == FieldOutput::Kernel::lucy ? lucy_cutoff(dimensions) : gaussian_cutoff)) {}

double FieldKernel::at(double square) const {
    if (square >= cutoff_ * cutoff_) return 0;
    if (kind_ == FieldOutput::Kernel::gaussian) return std::exp(-0.5 * square / (width_ * width_));
    const double q = std::sqrt(square) / cutoff_, rest = 1 - q;
    return (1 + 3 * q) * rest * rest * rest;
}

double FieldKernel::along(double square, double from, double to) const {
    const double inside = cutoff_ * cutoff_ - square;
    if (inside <= 0) return 0;
    const double half = std::sqrt(inside);  // of the chord within the cutoff
    const double begin = std::clamp(from, -half, half), end = std::clamp(to, -half, half);
    if (begin >= end) return 0;
    if (kind_ == FieldOutput::Kernel::lucy) return lucy_integral(square, end) - lucy_integral(square, begin);
    const double unit = std::numbers::sqrt2 * width_;
    return std::exp(-square / (unit * unit)) * 0.5 * std::sqrt(std::numbers::pi) * unit *
           (std::erf(end / unit) - std::erf(begin / unit));
}

// Of (1 + 3 q)(1 - q)^3 = 1 - 6 q2 + 8 q3 - 3 q4 with r2 = p2 + t2, from t = 0; p2 is `square`.
double FieldKernel::lucy_integral(double square, double to) const {
    const double t = to / cutoff_, t2 = t * t, p2 = square / (cutoff_ * cutoff_), r = std::sqrt(p2 + t2);
    const double logarithm = p2 > 0 ? p2 * std::asinh(t / std::sqrt(p2)) : 0;
    const double second = t * (p2 + t2 / 3);
    const double third = 0.25 * t * r * r * r + 0.375 * p2 * (t * r + logarithm);
    const double fourth = t * (p2 * p2 + t2 * (2 * p2 / 3 + t2 / 5));
    return cutoff_ * (t - 6 * second + 8 * third - 3 * fourth);
}

}  // namespace grainreel
