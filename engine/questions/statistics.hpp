// Plain statistics of numbers, some of which may be NaN: those are left out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace grainreel {

struct Statistics {
    std::size_t count = 0;
    double least = std::numeric_limits<double>::quiet_NaN(), most = least, mean = least, deviation = least;
    std::size_t where_least = 0, where_most = 0;  // places in the list
};

// deviation: the standard deviation of the sample, with count - 1; NaN of fewer than two.
inline Statistics statistics_of(const std::vector<double>& values) {
    Statistics all;
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double value = values[i];
        if (!std::isfinite(value)) continue;
        if (all.count == 0 || value < all.least) all.least = value, all.where_least = i;
        if (all.count == 0 || value > all.most) all.most = value, all.where_most = i;
        sum += value;
        ++all.count;
    }
    if (all.count == 0) return all;
    all.mean = sum / static_cast<double>(all.count);
    double squares = 0;
    for (const double value : values)
        if (std::isfinite(value)) squares += (value - all.mean) * (value - all.mean);
    if (all.count > 1) all.deviation = std::sqrt(squares / static_cast<double>(all.count - 1));
    return all;
}

}  // namespace grainreel
