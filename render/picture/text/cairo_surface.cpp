#include "render/picture/text/cairo_surface.hpp"

#include <cstdint>

namespace grainreel {

CairoSurface blank_surface(const Rectangle& part, const Colour& colour, double alpha) {
    CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, part.width, part.height));
    const CairoContext on(cairo_create(surface.get()));
    fill_surface(on.get(), colour, alpha);
    return surface;
}

void fill_surface(cairo_t* on, const Colour& colour, double alpha) {
    cairo_set_operator(on, CAIRO_OPERATOR_SOURCE);
    cairo_set_source_rgba(on, colour.red, colour.green, colour.blue, alpha);
    cairo_paint(on);
    cairo_set_operator(on, CAIRO_OPERATOR_OVER);
}

void copy_surface(cairo_surface_t* from, const Rectangle& to, Picture& picture) {
    copy_part(from, {0, 0, to.width, to.height}, to.x, to.y, picture);
}

void copy_part(cairo_surface_t* from, const Rectangle& part, int x, int y, Picture& picture) {
    cairo_surface_flush(from);
    const unsigned char* pixels = cairo_image_surface_get_data(from);
    const int stride = cairo_image_surface_get_stride(from);
    for (int j = part.y; j < part.y + part.height; ++j) {
        const auto* row =
            reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(j) * stride);
        std::uint8_t* out = picture.pixel(x + part.x, y + j);
        for (int i = part.x; i < part.x + part.width; ++i, out += 4) {
            out[0] = static_cast<std::uint8_t>(row[i] >> 16);
            out[1] = static_cast<std::uint8_t>(row[i] >> 8);
            out[2] = static_cast<std::uint8_t>(row[i]);
            out[3] = static_cast<std::uint8_t>(row[i] >> 24);
        }
    }
    divide_by_alpha(picture, {x + part.x, y + part.y, part.width, part.height});
}

}  // namespace grainreel
