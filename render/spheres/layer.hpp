// A picture to be laid over others: 8-bit sRGB, multiplied by its alpha.
#pragma once

#include <cstdint>
#include <vector>

namespace grainreel {

struct Layer {
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;  // rows from the top; red in the lowest byte, alpha in the highest

    Layer(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, 0) {}
    std::uint32_t* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * width; }
    const std::uint32_t* row(int y) const { return pixels.data() + static_cast<std::size_t>(y) * width; }
};

}  // namespace grainreel
