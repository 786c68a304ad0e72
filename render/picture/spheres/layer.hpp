// A picture to be laid over others: 8-bit sRGB, multiplied by its alpha.
#pragma once

#include <cstdint>
#include <vector>

namespace grainreel {

struct Layer {
    // Part of a row from the first pixel that is not clear to after the last.
    struct Span {
        int begin = 0, end = 0;
    };
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;  // rows from the top; red in the lowest byte, alpha in the highest
    std::vector<Span> spans;            // of each row; all beside it is clear

    Layer(int w, int h)
        : width(w),
          height(h),
          pixels(static_cast<std::size_t>(w) * h, 0),
          spans(static_cast<std::size_t>(h)) {}
    std::uint32_t* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * width; }
    const std::uint32_t* row(int y) const { return pixels.data() + static_cast<std::size_t>(y) * width; }
};

}  // namespace grainreel
