// Mean of a few seeds and its standard error.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainreel {

struct SeedMean {
    double mean = 0, error = 0;
};
inline SeedMean seed_mean_of(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (const double v : values) mean += v / count;
    for (const double v : values) squares += (v - mean) * (v - mean);
    return {mean, std::sqrt(squares / std::max(1.0, count - 1) / count)};
}

}  // namespace grainreel
