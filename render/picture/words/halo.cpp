#include "render/picture/words/halo.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace grainreel {
namespace {

// How strong the halo is at each pixel around one of the words', 0 to 1.
struct Stamp {
    int reach = 0;
    std::vector<float> strength;  // rows of 2 reach + 1
};

Stamp make_stamp(double reach) {
    constexpr double kFade = 1.2;  // pixels, over which it ends
    Stamp stamp;
    stamp.reach = static_cast<int>(std::ceil(reach + 0.5 * kFade));
    for (int y = -stamp.reach; y <= stamp.reach; ++y)
        for (int x = -stamp.reach; x <= stamp.reach; ++x) {
            const double inside = reach + 0.5 * kFade - std::hypot(x, y);
            stamp.strength.push_back(static_cast<float>(std::clamp(inside / kFade, 0.0, 1.0)));
        }
    return stamp;
}

const std::uint32_t* row_of(cairo_surface_t* surface, int y) {
    const unsigned char* pixels = cairo_image_surface_get_data(surface);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
    return reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(y) * stride);
}

// Over a pixel's own alpha: strokes of small letters are thinner than a pixel and never opaque.
constexpr float kGain = 2.2f;

// The halo's alpha, 0 to 255, in the part. Most of a surface is empty: only what is not casts one.
std::vector<float> halo_in(cairo_surface_t* from, const Rectangle& part, const Stamp& stamp) {
    std::vector<float> halo(static_cast<std::size_t>(part.width) * part.height, 0);
    const int r = stamp.reach, wide = cairo_image_surface_get_width(from),
              high = cairo_image_surface_get_height(from);
    for (int y = std::max(0, part.y - r); y < std::min(high, part.y + part.height + r); ++y) {
        const std::uint32_t* row = row_of(from, y);
        for (int x = std::max(0, part.x - r); x < std::min(wide, part.x + part.width + r); ++x) {
            const float alpha = std::min(255.0f, kGain * static_cast<float>(row[x] >> 24));
            if (alpha == 0) continue;
            for (int j = std::max(y - r, part.y); j <= std::min(y + r, part.y + part.height - 1); ++j)
                for (int i = std::max(x - r, part.x); i <= std::min(x + r, part.x + part.width - 1); ++i) {
                    const float strength =
                        stamp.strength[static_cast<std::size_t>((j - y + r) * (2 * r + 1) + (i - x + r))];
                    float& at = halo[static_cast<std::size_t>(j - part.y) * part.width + (i - part.x)];
                    at = std::max(at, alpha * strength);
                }
        }
    }
    return halo;
}

}  // namespace

Halo halo_of(const TypeScale& type, const Palette& palette) {
    return {palette.background, std::max(2.0, 0.18 * type.minor)};
}

void copy_part_on_halo(cairo_surface_t* from, const Rectangle& part, int x, int y, const Halo& halo,
                       Picture& picture) {
    cairo_surface_flush(from);
    const std::vector<float> strength = halo_in(from, part, make_stamp(halo.reach));
    const float colour[3] = {static_cast<float>(halo.colour.red), static_cast<float>(halo.colour.green),
                             static_cast<float>(halo.colour.blue)};
    std::size_t at = 0;
    for (int j = 0; j < part.height; ++j) {
        const std::uint32_t* row = row_of(from, part.y + j) + part.x;
        std::uint8_t* out = picture.pixel(x + part.x, y + part.y + j);
        for (int i = 0; i < part.width; ++i, out += 4) {
            const float left = strength[at++] * (1 - static_cast<float>(row[i] >> 24) / 255);
            for (int c = 0; c < 3; ++c)
                out[c] = static_cast<std::uint8_t>(static_cast<float>((row[i] >> (16 - 8 * c)) & 255) +
                                                   left * colour[c] + 0.5f);
            out[3] = static_cast<std::uint8_t>(static_cast<float>(row[i] >> 24) + left + 0.5f);
        }
    }
    divide_by_alpha(picture, {x + part.x, y + part.y, part.width, part.height});
}

}  // namespace grainreel
