// Row upon row of pixels, as over() and scaled() of pixel.hpp have it, many at once.
#pragma once

#include <cstdint>

namespace grainreel {

// below[i] = over(scaled(top[i], strength), below[i]) for `count` pixels; strength: 0 to 255.
void lay_over(std::uint32_t* below, const std::uint32_t* top, int count, std::uint32_t strength = 255);

}  // namespace grainreel
