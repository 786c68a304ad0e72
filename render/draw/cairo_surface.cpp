#include "render/draw/cairo_surface.hpp"

#include <cstdint>

namespace grainreel {

CairoSurface blank_surface(const Rectangle& part, const Colour& colour) {
    CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, part.width, part.height));
    const CairoContext on(cairo_create(surface.get()));
    fill_surface(on.get(), colour);
    return surface;
}

void fill_surface(cairo_t* on, const Colour& colour) {
    cairo_set_source_rgb(on, colour.red, colour.green, colour.blue);
    cairo_paint(on);
}

void copy_surface(cairo_surface_t* from, const Rectangle& to, Picture& picture) {
    cairo_surface_flush(from);
    const unsigned char* pixels = cairo_image_surface_get_data(from);
    const int stride = cairo_image_surface_get_stride(from);
    for (int y = 0; y < to.height; ++y) {
        const auto* row =
            reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(y) * stride);
        std::uint8_t* out = picture.pixel(to.x, to.y + y);
        for (int x = 0; x < to.width; ++x, out += 4) {
            out[0] = static_cast<std::uint8_t>(row[x] >> 16);
            out[1] = static_cast<std::uint8_t>(row[x] >> 8);
            out[2] = static_cast<std::uint8_t>(row[x]);
            out[3] = 255;
        }
    }
}

}  // namespace grainreel
