// What a column holds at a moment at which there is nothing to measure.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace grainreel {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

inline void add_no_values(std::vector<double>& row, std::size_t columns) {
    row.insert(row.end(), columns, kNoValue);
}

}  // namespace grainreel
