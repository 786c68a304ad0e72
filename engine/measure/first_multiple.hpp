// Rhythms that are no whole number of steps.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace grainreel {

// The first step that is nearest to a multiple of `every` and not below `step` (which is not negative); the
// largest number there is where `every` is 0.
inline std::int64_t first_multiple(double every, std::int64_t step) {
    if (every <= 0) return std::numeric_limits<std::int64_t>::max();
    double count = std::floor(static_cast<double>(step) / every);
    while (std::llround(count * every) < step) ++count;
    return std::llround(count * every);
}

}  // namespace grainreel
