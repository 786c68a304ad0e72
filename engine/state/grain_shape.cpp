#include "engine/state/grain_shape.hpp"

#include <cmath>
#include <numbers>

namespace grainreel {

bool is_possible(const GrainShape& shape) {
    const auto power = [](double n) { return n >= 2 && n <= kMostBlockiness; };
    return shape.half.allFinite() && shape.half.minCoeff() > 0 && power(shape.along) && power(shape.around);
}

double radius_by_volume(const GrainShape& shape) {
    const double e = 2 / shape.along, f = 2 / shape.around;
    const double volume = 2 * shape.half.prod() * e * f * std::beta(e / 2 + 1, e) * std::beta(f / 2, f / 2);
    return std::cbrt(volume / (4.0 / 3 * std::numbers::pi));
}

}  // namespace grainreel
