// Pixels of 8 bits a channel, multiplied by their alpha: red in the lowest byte, alpha in the highest.
#pragma once

#include <cstdint>

namespace grainreel {

// All four channels times share / 255, rounded; two in each half.
inline std::uint32_t scaled(std::uint32_t pixel, std::uint32_t share) {
    constexpr std::uint32_t kEven = 0x00ff00ffu, kHalf = 0x00800080u;
    const auto pair = [&](std::uint32_t two) {
        const std::uint32_t product = two * share + kHalf;  // / 255: (p + p / 256) / 256
        return ((product + ((product >> 8) & kEven)) >> 8) & kEven;
    };
    return pair(pixel & kEven) + (pair((pixel >> 8) & kEven) << 8);
}

inline std::uint32_t over(std::uint32_t top, std::uint32_t below) {
    const std::uint32_t left = 255 - (top >> 24);
    if (left == 255) return below;
    if (left == 0) return top;
    return top + scaled(below, left);
}

// share: 0 to 1.
inline std::uint32_t faded(std::uint32_t pixel, float share) {
    return scaled(pixel, static_cast<std::uint32_t>(share * 255 + 0.5f));
}

}  // namespace grainreel
