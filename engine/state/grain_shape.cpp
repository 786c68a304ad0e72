#include "engine/state/grain_shape.hpp"

#include <numbers>

#include "engine/base/mathematics.hpp"

namespace grainreel {

namespace {

// The logarithm of the gamma function of x > 0: Stirling's series (Abramowitz and Stegun, Handbook of
// Mathematical Functions (1964), 6.1.41) beyond 10, where its error is below 1e-12, and gamma(x + 1) = x
// gamma(x) up to there.
double log_gamma(double x) {
    double below = 1;
    for (; x < 10; ++x) below *= x;
    const double inverse = 1 / x, square = inverse * inverse;
    const double series =
        inverse * (1.0 / 12 - square * (1.0 / 360 - square * (1.0 / 1260 - square * (1.0 / 1680))));
    return (x - 0.5) * math::log(x) - x + 0.5 * math::log(2 * std::numbers::pi) + series - math::log(below);
}

}  // namespace

bool is_possible(const GrainShape& shape) {
    const auto power = [](double n) { return n >= 2 && n <= kMostBlockiness; };
    return shape.half.allFinite() && shape.half.minCoeff() > 0 && power(shape.along) && power(shape.around);
}

double radius_by_volume(const GrainShape& shape) {
    if (shape.along == 2 && shape.around == 2) return math::cbrt(shape.half.prod());
    const auto beta_function = [](double x, double y) {
        return math::exp(log_gamma(x) + log_gamma(y) - log_gamma(x + y));
    };
    const double e = 2 / shape.along, f = 2 / shape.around;
    const double volume =
        2 * shape.half.prod() * e * f * beta_function(e / 2 + 1, e) * beta_function(f / 2, f / 2);
    return math::cbrt(volume / (4.0 / 3 * std::numbers::pi));
}

}  // namespace grainreel
