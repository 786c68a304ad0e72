#include "engine/measure/interval.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/error.hpp"

namespace grainreel {

double student_probability(double t, int freedom) {
    const double angle = std::atan2(t, std::sqrt(freedom));  // theta of 26.7.3
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const bool odd = freedom % 2 == 1;
    // The series is cos + 2/3 cos^3 + ..., up to cos^(freedom - 2), or 1 + 1/2 cos^2 + ... up to the same
    // power.
    double term = odd ? cosine : 1, sum = 0;
    for (int power = odd ? 1 : 0; power <= freedom - 2; power += 2) {
        sum += term;
        term *= cosine * cosine * (power + 1) / (power + 2);
    }
    return odd ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
}

double student_t(double probability, int freedom) {
    GRAINREEL_CHECK(probability > 0 && probability < 1 && freedom >= 1);
    double low = 0, high = 1;
    while (student_probability(high, freedom) < probability) high *= 2;
    while (high - low > 1e-13 * high) {
        const double middle = (low + high) / 2;
        (student_probability(middle, freedom) < probability ? low : high) = middle;
    }
    return high;
}

MeanInterval mean_interval(const std::vector<double>& values, double probability) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    MeanInterval result{0, 0, nan};
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        ++result.count;
        result.mean += value;
    }
    const auto count = static_cast<double>(result.count);
    result.mean = result.count > 0 ? result.mean / count : nan;
    if (result.count < 2) return result;
    double squares = 0;
    for (const double value : values)
        if (std::isfinite(value)) squares += (value - result.mean) * (value - result.mean);
    const double deviation = std::sqrt(squares / (count - 1));
    result.half = student_t(probability, static_cast<int>(result.count) - 1) * deviation / std::sqrt(count);
    return result;
}

}  // namespace grainreel
