#include "render/draw/compose.hpp"

#include <cstring>

namespace grainreel {
namespace {

// `top` over `below`, all four channels at once: two in each half, rounded.
std::uint32_t over(std::uint32_t top, std::uint32_t below) {
    const std::uint32_t left = 255 - (top >> 24);
    if (left == 255) return below;
    if (left == 0) return top;
    constexpr std::uint32_t kEven = 0x00ff00ffu, kHalf = 0x00800080u;
    const auto scaled = [&](std::uint32_t pair) {
        const std::uint32_t product = pair * left + kHalf;  // / 255: (p + p / 256) / 256
        return ((product + ((product >> 8) & kEven)) >> 8) & kEven;
    };
    return top + scaled(below & kEven) + (scaled((below >> 8) & kEven) << 8);
}

}  // namespace

void compose(const std::vector<std::uint32_t>& behind, const Layer& grains,
             const std::vector<std::uint32_t>& before, const Rectangle& port, Picture& picture) {
    std::vector<std::uint32_t> row(static_cast<std::size_t>(port.width));
    for (int y = 0; y < port.height; ++y) {
        const std::size_t first = static_cast<std::size_t>(port.height - 1 - y) * row.size();
        const std::uint32_t* middle = grains.row(y);
        for (std::size_t x = 0; x < row.size(); ++x)
            row[x] = over(before[first + x], over(middle[x], behind[first + x]));
        std::memcpy(picture.pixel(port.x, port.y + y), row.data(), row.size() * sizeof row[0]);
    }
}

}  // namespace grainreel
