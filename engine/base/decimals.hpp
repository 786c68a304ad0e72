// Comparisons of numbers that a user wrote in decimals and units. "5.6 mm" is not 2.5 times "2.24 mm" to the
// last bit, nor is every number of millimetres that of its metres; what was meant to be equal is.
#pragma once

#include <algorithm>
#include <cmath>

namespace grainreel {

constexpr double kSameDecimals = 1e-9;  // relative

// How far two numbers of this size may differ and mean the same.
inline double slack_of(double a, double b) {
    return kSameDecimals * std::max(std::abs(a), std::abs(b));
}
inline bool clearly_less(double a, double b) {
    return a < b - slack_of(a, b);
}
inline bool clearly_more(double a, double b) {
    return clearly_less(b, a);
}

}  // namespace grainreel
