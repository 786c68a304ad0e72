// The same grains in two frames: ids rise along both, and some may have come or gone between them.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/frame.hpp"

namespace grainreel {

inline constexpr std::size_t kNoRow = static_cast<std::size_t>(-1);

// For each grain of `frame`, its row in `other`; kNoRow where it is not there.
inline std::vector<std::size_t> rows_in(const Frame& other, const Frame& frame) {
    std::vector<std::size_t> rows(frame.size(), kNoRow);
    std::size_t row = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        while (row < other.size() && other.id[row] < frame.id[i]) ++row;
        if (row < other.size() && other.id[row] == frame.id[i]) rows[i] = row;
    }
    return rows;
}

}  // namespace grainreel
