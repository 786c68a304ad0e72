// A layer is a picture that is laid over others: 8-bit sRGB, multiplied by its alpha. Here are its pixels and
// how they are laid over each other, one by one, or by rows (lay_over.cpp, compiled for each instruction
// set).
#pragma once

#include <cstdint>
#include <vector>

namespace grainreel {

struct Layer {
    // The part of a row from the first pixel that is not clear to just after the last such pixel.
    struct Span {
        int begin = 0, end = 0;
    };
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;  // rows from the top; red in the lowest byte, alpha in the highest
    std::vector<Span> spans;            // one for each row; all pixels beside it are clear

    Layer(int w, int h)
        : width(w),
          height(h),
          pixels(static_cast<std::size_t>(w) * h, 0),
          spans(static_cast<std::size_t>(h)) {}
    std::uint32_t* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * width; }
    const std::uint32_t* row(int y) const { return pixels.data() + static_cast<std::size_t>(y) * width; }
};

// A pixel with all four channels multiplied by share / 255 and rounded; two channels are computed at once.
inline std::uint32_t scaled(std::uint32_t pixel, std::uint32_t share) {
    constexpr std::uint32_t kEven = 0x00ff00ffu, kHalf = 0x00800080u;
    const auto pair = [&](std::uint32_t two) {
        const std::uint32_t product = two * share + kHalf;  // divided by 255 as (p + p / 256) / 256
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

// below[i] = over(scaled(top[i], strength), below[i]) for `count` pixels; strength: 0 to 255.
void lay_over(std::uint32_t* below, const std::uint32_t* top, int count, std::uint32_t strength = 255);

// Multiplies the colours of `count` pixels by shares / 255. Their alpha stays.
void darken_row(std::uint32_t* pixels, const std::uint8_t* shares, int count);

}  // namespace grainreel
