// Times that somebody types, as in --from 0.3, and the moments that they mean. One tolerance for all
// commands.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace grainreel {

// How far (s) a typed time may lie from a moment and still mean it. Moments lie at whole steps, so this is
// half a step. It is also a hundredth of the way to the next moment, because the step of other programs is
// not always known, and what six digits leave open, because messages show so many; but these at most a
// quarter of that way. step: s, or 0 where it is not known. gap: s, to the nearest other moment.
inline double room_beside(double time, double step, double gap) {
    constexpr double share = 0.01, most = 0.25, six_digits = 5e-6, rounding = 1e-9;
    const double room = std::min(most * gap, std::max(share * gap, six_digits * std::abs(time)));
    const double half = 0.5 * step;
    return std::max(half, std::isfinite(room) ? room : 0) * (1 + rounding) + rounding * std::abs(time);
}

// The same for each of some moments. times: s, rising.
inline double room_beside(const std::vector<double>& times, std::size_t k, double step) {
    double gap = std::numeric_limits<double>::infinity();
    if (k > 0) gap = std::min(gap, times[k] - times[k - 1]);
    if (k + 1 < times.size()) gap = std::min(gap, times[k + 1] - times[k]);
    return room_beside(times[k], step, gap);
}

// The indices of the moments from one typed time to another.
inline std::vector<std::size_t> typed_span(const std::vector<double>& times, double step,
                                           std::optional<double> from, std::optional<double> to) {
    std::vector<std::size_t> inside;
    for (std::size_t k = 0; k < times.size(); ++k) {
        const double room = room_beside(times, k, step);
        if (times[k] < from.value_or(times[k]) - room || times[k] > to.value_or(times[k]) + room) continue;
        inside.push_back(k);
    }
    return inside;
}

}  // namespace grainreel
