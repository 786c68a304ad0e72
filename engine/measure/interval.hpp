// The mean of a sample and its 95 % confidence interval after Student (1908, Biometrika 6, 1).
#pragma once

#include <cstddef>
#include <vector>

namespace grainreel {

// The t with P(|T| <= t) = probability for `freedom` degrees of freedom, to a relative 1e-12. 0 < probability
// < 1, freedom >= 1.
double student_t(double probability, int freedom);

// P(|T| <= t) for t >= 0, by the finite sums of Abramowitz and Stegun (1964), 26.7.3 and 26.7.4.
double student_probability(double t, int freedom);

struct MeanInterval {
    std::size_t count = 0;  // number of finite values
    double mean = 0;        // NaN without any
    double half = 0;        // half the width of the interval, t s / sqrt(n); NaN for fewer than two values
};

// Mean and interval of the values that are finite.
MeanInterval mean_interval(const std::vector<double>& values, double probability = 0.95);

}  // namespace grainreel
