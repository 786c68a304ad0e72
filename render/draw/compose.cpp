#include "render/draw/compose.hpp"

#include <algorithm>
#include <cstring>

#include "render/spheres/pixel.hpp"

namespace grainreel {
namespace {

constexpr std::uint32_t kGhost = 90;  // strength of a ghost, of 255

// Eight pixels at once where there is nothing to lay over, as in most of a picture.
constexpr int kSpan = 8;
bool nothing(const std::uint32_t* pixels) {
    std::uint32_t any = 0;
    for (int i = 0; i < kSpan; ++i) any |= pixels[i];
    return any == 0;
}

struct Row {
    const std::uint32_t *behind, *grains, *ghosts, *before;  // ghosts may be null
    std::uint32_t* out;
};

std::uint32_t pixel_of(const Row& row, int x) {
    std::uint32_t grains = row.grains[x];
    if (row.ghosts) grains = over(scaled(row.ghosts[x], kGhost), grains);
    return over(row.before[x], over(grains, row.behind[x]));
}

void compose_row(const Row& row, int width) {
    int x = 0;
    for (; x + kSpan <= width; x += kSpan) {
        const bool bare =
            nothing(row.grains + x) && nothing(row.before + x) && (!row.ghosts || nothing(row.ghosts + x));
        if (bare) {
            std::memcpy(row.out + x, row.behind + x, kSpan * sizeof *row.out);
            continue;
        }
        for (int i = x; i < x + kSpan; ++i) row.out[i] = pixel_of(row, i);
    }
    for (; x < width; ++x) row.out[x] = pixel_of(row, x);
}

}  // namespace

void compose(const Layers& layers, const Rectangle& port, Picture& picture, Team& team) {
    const auto width = static_cast<std::size_t>(port.width);
    team.run([&](int member) {
        for (int y = member; y < port.height; y += team.size()) {
            const std::size_t first = static_cast<std::size_t>(port.height - 1 - y) * width;
            compose_row({layers.behind.data() + first, layers.grains.row(y),
                         layers.ghosts ? layers.ghosts->row(y) : nullptr, layers.before.data() + first,
                         reinterpret_cast<std::uint32_t*>(picture.pixel(port.x, port.y + y))},
                        port.width);
        }
    });
}

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
