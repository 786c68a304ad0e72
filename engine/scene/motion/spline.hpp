// Natural cubic splines: the curve through points at rising times whose second derivative is continuous, and
// zero at both ends. de Boor 1978, A Practical Guide to Splines, ch. IV.
#pragma once

#include <cstddef>
#include <vector>

namespace grainreel {

// value = c0 + c1 s + c2 s2 + c3 s3, with s the time since the piece's beginning. V: a vector of fixed size.
template <class V>
struct CubicPiece {
    V c0, c1, c2, c3;
    V value(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
    V slope(double s) const { return c1 + s * (2 * c2 + 3 * s * c3); }
};

// One piece between every two points. times: rising, at least 2; as many points.
template <class V>
std::vector<CubicPiece<V>> natural_spline(const std::vector<double>& times, const std::vector<V>& points) {
    const std::size_t last = times.size() - 1;
    const auto width = [&](std::size_t i) { return times[i + 1] - times[i]; };
    const auto rise = [&](std::size_t i) { return V((points[i + 1] - points[i]) / width(i)); };
    // Second derivatives m: h[i-1] m[i-1] + 2 (h[i-1] + h[i]) m[i] + h[i] m[i+1] = 6 (rise[i] - rise[i-1]),
    // solved by elimination. What is left of the row above stands in `beyond`.
    std::vector<V> second(times.size(), V::Zero());
    std::vector<double> beyond(times.size(), 0.0);
    for (std::size_t i = 1; i < last; ++i) {
        const double pivot = 2 * (width(i - 1) + width(i)) - width(i - 1) * beyond[i - 1];
        beyond[i] = width(i) / pivot;
        second[i] = (6 * (rise(i) - rise(i - 1)) - width(i - 1) * second[i - 1]) / pivot;
    }
    for (std::size_t i = last; i-- > 1;) second[i] -= beyond[i] * second[i + 1];

    std::vector<CubicPiece<V>> pieces;
    pieces.reserve(last);
    for (std::size_t i = 0; i < last; ++i) {
        const double h = width(i);
        pieces.push_back({points[i], rise(i) - h / 6 * (2 * second[i] + second[i + 1]), 0.5 * second[i],
                          (second[i + 1] - second[i]) / (6 * h)});
    }
    return pieces;
}

}  // namespace grainreel
