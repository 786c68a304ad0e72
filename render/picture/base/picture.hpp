// A drawn frame: 8-bit sRGB pixels, rows from the top.
#pragma once

#include <cstdint>
#include <vector>

#include "render/picture/base/rectangle.hpp"

namespace grainreel {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // width * height * 4, no row padding; not multiplied by alpha, which is
                                     // 255 but in films with a transparent background
    // Pictures with the same number, other than 0, are alike outside of `moving`, which they share too.
    std::uint64_t still = 0;
    std::vector<Rectangle> moving;

    Picture() = default;
    Picture(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * h * 4) {}
    std::uint8_t* pixel(int x, int y) { return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4; }
    const std::uint8_t* pixel(int x, int y) const {
        return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
    }
};

// From colours multiplied by their alpha, as layers have them, to plain ones, as pictures have them.
void divide_by_alpha(Picture& picture, const Rectangle& port);

}  // namespace grainreel
