// Which species the segregation indices compare.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

// The species of the largest and of the smallest mean diameter. All of one size: the first and the second.
// There must be two at least.
struct BigAndSmall {
    std::size_t big = 0, small = 0;
};
BigAndSmall big_and_small(const std::vector<Species>& species);

}  // namespace grainreel
