#include "render/picture/base/picture.hpp"

#include <algorithm>

namespace grainreel {

void divide_by_alpha(Picture& picture, const Rectangle& port) {
    for (int y = 0; y < port.height; ++y) {
        std::uint8_t* pixel = picture.pixel(port.x, port.y + y);
        for (int x = 0; x < port.width; ++x, pixel += 4) {
            const unsigned alpha = pixel[3];
            if (alpha == 0 || alpha == 255) continue;
            for (int c = 0; c < 3; ++c)
                pixel[c] = static_cast<std::uint8_t>(std::min(255u, (pixel[c] * 255 + alpha / 2) / alpha));
        }
    }
}

}  // namespace grainreel
