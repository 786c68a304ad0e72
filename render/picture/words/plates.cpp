#include "render/picture/words/plates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace grainreel {
namespace {

void rounded(cairo_t* on, const Rectangle& box, double radius) {
    constexpr double quarter = 0.5 * std::numbers::pi;
    cairo_new_sub_path(on);
    cairo_arc(on, box.x + box.width - radius, box.y + radius, radius, -quarter, 0);
    cairo_arc(on, box.x + box.width - radius, box.y + box.height - radius, radius, 0, quarter);
    cairo_arc(on, box.x + radius, box.y + box.height - radius, radius, quarter, 2 * quarter);
    cairo_arc(on, box.x + radius, box.y + radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(on);
}

// A pixel over another, with alphas of 0 to 255; the upper one is multiplied by its alpha.
void lay_pixel(std::uint32_t upper, std::uint8_t* out) {
    const unsigned alpha = upper >> 24;
    if (alpha == 0) return;
    const double left = out[3] * (255.0 - alpha) / 255, all = alpha + left;
    for (int c = 0; c < 3; ++c) {
        const unsigned own = (upper >> (16 - 8 * c)) & 255;
        out[c] = static_cast<std::uint8_t>(std::min(255.0, (255 * own + out[c] * left) / all + 0.5));
    }
    out[3] = static_cast<std::uint8_t>(all + 0.5);
}

void lay_part(cairo_surface_t* from, const Rectangle& part, const Rectangle& gutter, Picture& picture) {
    cairo_surface_flush(from);
    const unsigned char* pixels = cairo_image_surface_get_data(from);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(from));
    for (int y = part.y; y < part.y + part.height; ++y) {
        const auto* row =
            reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(y) * stride);
        for (int x = part.x; x < part.x + part.width; ++x)
            lay_pixel(row[x], picture.pixel(gutter.x + x, gutter.y + y));
    }
}

}  // namespace

std::vector<Rectangle> plates_around(const std::vector<WordBox>& boxes, const TypeScale& type,
                                     const Rectangle& gutter) {
    const double room = 0.45 * type.margin;
    std::vector<Rectangle> plates;
    for (const WordBox& box : boxes) {
        if (box.width <= 0 || box.height <= 0) continue;
        const int left = std::max(0, static_cast<int>(box.x - room)),
                  top = std::max(0, static_cast<int>(box.y - room)),
                  right = std::min(gutter.width, static_cast<int>(std::ceil(box.x + box.width + room))),
                  bottom = std::min(gutter.height, static_cast<int>(std::ceil(box.y + box.height + room)));
        plates.push_back({left, top, right - left, bottom - top});
    }
    return plates;
}

void paint_plates(cairo_t* on, const std::vector<Rectangle>& plates, const TypeScale& type,
                  const Palette& palette) {
    cairo_set_source_rgba(on, palette.background.red, palette.background.green, palette.background.blue,
                          plate_strength(palette));
    for (const Rectangle& plate : plates) rounded(on, plate, 0.3 * type.main);
    cairo_fill(on);
}

void lay_plates(cairo_surface_t* from, const std::vector<Rectangle>& plates, const Rectangle& gutter,
                Picture& picture) {
    for (const Rectangle& plate : plates) lay_part(from, plate, gutter, picture);
}

}  // namespace grainreel
